#include "foundation/error.hpp"
#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/import.hpp"
#include "scene/patch_mesh.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace radiosity {
namespace {

// Quadrilateral with corners in a plane (shoelace), mm^2.
double quad_area(const std::array<std::array<double, 2>, 4>& corners) {
  double doubled = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& a = corners[k];
    const auto& b = corners[(k + 1) % 4];
    doubled += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(doubled) / 2;
}

const double kShortFootprint = quad_area({{{130, 65}, {82, 225}, {240, 272}, {290, 114}}});
const double kTallFootprint = quad_area({{{423, 247}, {265, 296}, {314, 456}, {472, 406}}});

TEST(Cube, HasTheDocumentedSurface) {
  const PatchMesh mesh = make_patches(built_in_scene("cube"));
  EXPECT_EQ(mesh.patch_count(), 6);
  EXPECT_EQ(mesh.channels(), 1);
  EXPECT_DOUBLE_EQ(mesh.area.sum(), 6);
  EXPECT_TRUE(mesh.topology.closed && mesh.topology.enclosure && mesh.topology.convex);
  EXPECT_NEAR(mesh.topology.volume, -1, 1e-14);
  EXPECT_DOUBLE_EQ(mesh.emission.sum(), 1);  // one face, 1 W/m^2
  EXPECT_TRUE((mesh.reflectance.array() == 0.5).all());
  for (Index i = 0; i < 6; ++i)  // fronts look to the centre
    EXPECT_NEAR(mesh.normal.col(i).dot(Vector3(0.5, 0.5, 0.5) - mesh.centroid.col(i)), 0.5, 1e-14);
}

TEST(Cube, GivesSixTimesASquareNumberOfPatches) {
  for (const auto& [wanted, expected] :
       std::map<Index, Index>{{6, 6}, {864, 864}, {3456, 3456}, {3300, 6 * 23 * 23}, {100, 96}}) {
    const PatchMesh mesh = make_patches(built_in_scene("cube"), {.patches = wanted});
    EXPECT_EQ(mesh.patch_count(), expected);
    EXPECT_NEAR(mesh.area.sum(), 6, 1e-11);
    EXPECT_NEAR(mesh.area.minCoeff(), mesh.area.maxCoeff(), 1e-14);
  }
}

TEST(CornellBoxClosed, HasTheAreasThatFollowFromTheMeasurement) {
  for (const Index patches : {0, 3300}) {
    const PatchMesh mesh = make_patches(built_in_scene("cornell-box-closed"), {.patches = patches});
    const auto areas = area_by_group(mesh);
    const double mm2 = 1e-6;
    EXPECT_NEAR(areas.at("floor"), (556 * 559.2 - kShortFootprint - kTallFootprint) * mm2, 1e-12);
    EXPECT_NEAR(areas.at("light"), 130 * 105 * mm2, 1e-13);
    EXPECT_NEAR(areas.at("ceiling"), (556 * 559.2 - 130 * 105) * mm2, 1e-12);
    EXPECT_NEAR(areas.at("left"), 548.8 * 559.2 * mm2, 1e-12);
    EXPECT_NEAR(areas.at("right"), 548.8 * 559.2 * mm2, 1e-12);
    EXPECT_NEAR(areas.at("back"), 556 * 548.8 * mm2, 1e-12);
    EXPECT_NEAR(areas.at("front"), 556 * 548.8 * mm2, 1e-12);
    EXPECT_EQ(areas.size(), 9U);
  }
}

TEST(CornellBoxClosed, IsWatertightAroundTheBlocks) {
  const Topology topology = make_patches(built_in_scene("cornell-box-closed")).topology;
  EXPECT_TRUE(topology.closed);
  EXPECT_TRUE(topology.enclosure);
  EXPECT_FALSE(topology.convex);
  EXPECT_NEAR(topology.volume, -(556 * 548.8 * 559.2 - 165 * kShortFootprint - 330 * kTallFootprint) * 1e-9,
              1e-12);
}

// The check can fail: taken as they are, the faces of the box overlap under the blocks.
TEST(CornellBoxClosed, IsNotClosedWhereTheFloorIsNotCut) {
  Scene scene = built_in_scene("cornell-box-closed");
  scene.contacts = Contacts::never;
  EXPECT_FALSE(topology(scene).closed);
}

TEST(CornellBox, IsOpenAtTheFrontOnly) {
  Scene scene = built_in_scene("cornell-box");
  EXPECT_FALSE(topology(scene).closed);
  // Closing the front by hand closes it: nothing else is open.
  const auto add = [&](double x, double y) {
    scene.vertices.emplace_back(x, y, 0.0);
    return static_cast<int>(scene.vertices.size()) - 1;
  };
  scene.faces.push_back({{add(0, 0), add(0.5528, 0), add(0.556, 0.5488), add(0, 0.5488)}, 4, 0, 0});
  EXPECT_TRUE(topology(scene).enclosure);
}

TEST(CornellBox, MeetsTheWantedNumberOfPatches) {
  for (const char* name : {"cornell-box", "cornell-box-closed"})
    for (const Index wanted : {800, 3300, 13000}) {
      const auto count =
          static_cast<double>(make_patches(built_in_scene(name), {.patches = wanted}).patch_count());
      EXPECT_NEAR(count / static_cast<double>(wanted), 1, wanted == 3300 ? 0.03 : 0.05)
          << name << " " << wanted;
    }
}

TEST(CornellBox, TakesItsColoursFromTheSpectra) {
  const Scene scene = built_in_scene("cornell-box");
  std::map<std::string, Material> materials;
  for (const Material& material : scene.materials) materials[material.name] = material;
  for (const auto& [name, material] : materials) {
    EXPECT_GE(material.reflectance.minCoeff(), 0) << name;
    EXPECT_LT(material.reflectance.maxCoeff(), 1) << name;
  }
  // The white paint is nearly neutral; published RGB triples for the others agree on which channel leads.
  EXPECT_LT(materials["white"].reflectance.maxCoeff() - materials["white"].reflectance.minCoeff(), 0.01);
  EXPECT_NEAR(materials["white"].reflectance.mean(), 0.737, 0.01);
  EXPECT_GT(materials["red"].reflectance[0], 5 * materials["red"].reflectance[1]);
  EXPECT_GT(materials["green"].reflectance[1], 3 * materials["green"].reflectance[0]);
  const Color light = materials["light"].emission;
  EXPECT_TRUE(light[0] > light[1] && light[1] > light[2] && light[2] > 0);
  EXPECT_NEAR(0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2], 40, 1e-9);
}

TEST(CourseBox, GivesThePatchCountsOfDocument003) {
  const Scene scene = built_in_scene("course-box");
  EXPECT_EQ(make_patches(scene).patch_count(), 30);
  const std::map<int, Index> counts = {{3, 192}, {4, 304}, {5, 464}, {6, 784}, {7, 784}, {0, 784}};
  for (const auto& [passes, count] : counts)
    EXPECT_EQ(make_patches(scene, {.edge = 130, .passes = passes}).patch_count(), count)
        << passes << " passes";
}

TEST(CourseBox, HasFrontsThatLookIntoTheRoom) {
  const PatchMesh mesh = make_patches(built_in_scene("course-box"));
  for (Index i = 0; i < 10; ++i)
    EXPECT_GT(mesh.normal.col(i).dot(Vector3(277.5, 277.5, 277.5) - mesh.centroid.col(i)), 277);
  for (Index i = 10; i < 30; ++i) {
    const Vector3 centre = i < 20 ? Vector3(185.5, 82.5, 169) : Vector3(368.5, 165, 351.25);
    EXPECT_GT(mesh.normal.col(i).dot(mesh.centroid.col(i) - centre), 50);
  }
}

TEST(BuiltInScenes, AreListedWhenANameIsUnknown) {
  try {
    open_scene("cornel-box");
    FAIL();
  } catch (const UsageError& error) {
    for (const BuiltInScene& scene : built_in_scenes())
      EXPECT_NE(std::string(error.what()).find(scene.name), std::string::npos) << error.what();
  }
}

TEST(BuiltInScenes, CanAllBeOpenedByName) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    EXPECT_EQ(open_scene(scene.name).name, scene.name);
    EXPECT_TRUE(open_scene(scene.name).camera.has_value());
  }
}

std::string refusal_of(const std::string& spec) {
  try {
    open_scene(spec);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BuiltInScenes, HaveTheDefaultsThatTheyList) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    EXPECT_TRUE(names_built_in_scene(scene.defaults)) << scene.defaults;
    const PatchMesh plain = make_patches(open_scene(scene.name));
    const PatchMesh listed = make_patches(open_scene(scene.defaults));
    EXPECT_EQ(plain.geometry_hash(), listed.geometry_hash()) << scene.name;
    EXPECT_EQ(plain.reflectance, listed.reflectance) << scene.name;
    EXPECT_EQ(plain.emission, listed.emission) << scene.name;
  }
}

TEST(BuiltInScenes, KeepTheSpecAsTheirName) {
  EXPECT_EQ(open_scene("rooms:n=5,door=0.3").name, "rooms:n=5,door=0.3");
  EXPECT_FALSE(names_built_in_scene("room:n=5"));
}

TEST(BuiltInScenes, RefuseKeysThatTheyDoNotKnow) {
  for (const BuiltInScene& scene : built_in_scenes()) {
    const std::string spec = scene.name + ":nonsense=1";
    EXPECT_NE(refusal_of(spec).find("'nonsense'"), std::string::npos) << refusal_of(spec);
  }
  EXPECT_NE(refusal_of("rooms:doors=1").find("'rooms' knows n, door, closed, reflectance"), std::string::npos)
      << refusal_of("rooms:doors=1");
}

TEST(BuiltInScenes, RefuseValuesOutOfRange) {
  for (const char* spec : {"rooms:n=0",
                           "rooms:n=65",
                           "rooms:n=two",
                           "rooms:door=1.5",
                           "rooms:door=0.0001",
                           "rooms:n=3,closed=3",
                           "rooms:door=nan",
                           "rooms:reflectance=1.1",
                           "keyhole:width=0",
                           "keyhole:height=2",
                           "disconnected-rooms:n=0",
                           "clutter:boxes=101",
                           "clutter:seed=-1",
                           "clutter:reflectance=-0.1",
                           "patio:sky=blue",
                           "colonnade:sky=blue",
                           "sphere-cavity:rings=2",
                           "bowl:beta=0",
                           "bowl:beta=180",
                           "bowl:rings=1",
                           "wedge:angle=0.5",
                           "wedge:angle=180",
                           "facing-plates:distance=0",
                           "slivers:aspect=1e7"}) {
    const std::string message = refusal_of(spec);
    EXPECT_NE(message.find(spec), std::string::npos) << spec << ": " << message;
  }
}

TEST(BuiltInScenes, ComeCloseToTheWantedNumberOfPatches) {
  for (const BuiltInScene& scene : built_in_scenes())
    for (const Index wanted : {600, 3300}) {
      const Scene made = open_scene(scene.name);
      const auto count = static_cast<double>(make_patches(made, {.patches = wanted}).patch_count());
      EXPECT_NEAR(count / static_cast<double>(wanted), 1, 0.04) << scene.name << " " << wanted;
    }
}

TEST(BuiltInScenes, LeaveFilesWhoseNamesContainAColonToTheImporter) {
  const TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(open_scene(folder.write("rooms:n=5.obj", triangle).string()).faces.size(), 1U);
  EXPECT_EQ(open_scene(folder.write("cube:1.obj", triangle).string()).faces.size(), 1U);
}

}  // namespace
}  // namespace radiosity
