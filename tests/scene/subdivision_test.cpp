#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "scene/face_subdivision.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/scene_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace radiosity {
namespace {

Scene single(const std::vector<Vector3>& corners) {
  SceneBuilder builder("single");
  builder.face(corners, builder.material({}), builder.group("all"));
  return builder.scene();
}

double longest_edge(const PatchMesh& mesh) {
  double longest = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const int n = mesh.patches[static_cast<std::size_t>(i)].corner_count;
    for (int k = 0; k < n; ++k)
      longest = std::max(longest, (mesh.corner(i, (k + 1) % n) - mesh.corner(i, k)).norm());
  }
  return longest;
}

TEST(Subdivision, CutsARectangleIntoRowsOfRectangles) {
  const PatchMesh mesh = make_patches(single({{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}), {.edge = 0.5});
  ASSERT_EQ(mesh.patch_count(), 6 * 4);
  for (Index i = 0; i < 24; ++i) {
    const Index row = i / 6, column = i % 6;
    EXPECT_TRUE(mesh.centroid.col(i).isApprox(
        Vector3(0.25 + 0.5 * static_cast<double>(column), 0.25 + 0.5 * static_cast<double>(row), 0)));
    EXPECT_NEAR(mesh.area[i], 0.25, 1e-15);
  }
}

TEST(Subdivision, KeepsEveryEdgeBelowTheLimit) {
  const std::vector<std::vector<Vector3>> shapes = {{{0, 0, 0}, {3, 0, 0}, {2, 2, 0}, {0, 1, 0}},
                                                    {{0, 0, 0}, {3, 0, 0}, {0, 1, 4}},
                                                    {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-3, 0}}};
  for (const auto& shape : shapes)
    for (const double edge : {2.0, 0.7, 0.1}) {
      const Scene scene = single(shape);
      const PatchMesh mesh = make_patches(scene, {.edge = edge});
      const double area = area_vector(scene, scene.faces[0]).norm();
      EXPECT_LE(longest_edge(mesh), edge * (1 + 1e-8));
      EXPECT_NEAR(mesh.area.sum(), area, 1e-12 * area);
      for (Index i = 0; i < mesh.patch_count(); ++i)
        EXPECT_GT(mesh.normal.col(i).dot(area_vector(scene, scene.faces[0])), 0.999999 * area);
    }
}

TEST(Subdivision, BisectsTrianglesToExactlyTheWantedNumber) {
  for (const Index wanted : {30, 31, 100, 777, 3300})
    EXPECT_EQ(make_patches(built_in_scene("course-box"), {.patches = wanted}).patch_count(), wanted);
}

TEST(Subdivision, HalvesTheLongestEdgeFirst) {
  const auto parts =
      bisect_to_count({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}}, 4);
  EXPECT_EQ(parts[0].size(), 1U);
  EXPECT_EQ(parts[1].size(), 3U);
}

TEST(Subdivision, RefusesWhatIsImpossible) {
  const Scene cube = built_in_scene("cube");
  EXPECT_THROW(make_patches(cube, {.patches = 5}), UsageError);
  EXPECT_THROW(make_patches(cube, {.patches = -1}), UsageError);
  EXPECT_THROW(make_patches(cube, {.patches = 100, .edge = 0.1}), UsageError);
  EXPECT_THROW(make_patches(cube, {.edge = -0.1}), UsageError);
  EXPECT_THROW(make_patches(cube, {.edge = std::numeric_limits<double>::quiet_NaN()}), UsageError);
  EXPECT_THROW(make_patches(cube, {.edge = 1e-9}), UsageError);  // would not fit in memory
  EXPECT_THROW(make_patches(cube, {.passes = 3}), UsageError);
}

TEST(Patches, DropFacesWithoutAreaAndSayWhich) {
  Scene scene = single({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Face flat = scene.faces[0];
  flat.corners = {0, 1, 1, 0};
  scene.faces.insert(scene.faces.begin(), {flat, flat});
  scene.faces.push_back(scene.faces.back());  // and a duplicate, which stays
  const PatchMesh mesh = make_patches(scene);
  EXPECT_EQ(mesh.patch_count(), 2);
  EXPECT_EQ(mesh.patches[0].face, 2);
  ASSERT_EQ(mesh.notes.size(), 2U);
  EXPECT_NE(mesh.notes[0].find("2 faces of zero area dropped, the first is face 0"), std::string::npos)
      << mesh.notes[0];
  scene.faces.resize(2);
  EXPECT_THROW(make_patches(scene), Error);
  EXPECT_THROW(make_patches(Scene{}), Error);
}

TEST(Patches, KeepSlivers) {
  const PatchMesh mesh = make_patches(single({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}}));
  EXPECT_NEAR(mesh.area[0], 5e-7, 1e-18);
}

TEST(Patches, RefuseScenesThatAreNotSound) {
  const Scene good = single({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  Scene bent = good, arrow = good, index = good, bright = good, infinite = good;
  bent.vertices[2].z() = 0.1;
  arrow.vertices[2] = {0.2, 0.2, 0};
  index.faces[0].corners[2] = 4;
  bright.materials[0].reflectance[1] = 1.1;
  infinite.vertices[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(make_patches(good));
  for (const Scene& scene : {bent, arrow, index, bright, infinite}) EXPECT_THROW(make_patches(scene), Error);
}

TEST(Patches, HaveOneChannelWhereAllIsGrey) {
  Scene scene = single({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.materials.push_back({"red, but of no face", Color(1, 0, 0), Color::Zero()});
  EXPECT_EQ(make_patches(scene).channels(), 1);
  scene.materials[0].emission = Color(1, 1, 0.5);
  EXPECT_EQ(make_patches(scene).channels(), 3);
}

TEST(GeometryHash, ChangesWithTheShapeAndNotWithTheColours) {
  const Scene scene = built_in_scene("cube");
  const std::uint64_t hash = make_patches(scene).geometry_hash();
  Scene painted = scene, moved = scene;
  painted.materials[0].reflectance = Color(0.1, 0.2, 0.3);
  for (Vector3& vertex : moved.vertices)
    if (vertex.y() == 1) vertex.y() = 1 + 1e-12;
  EXPECT_EQ(make_patches(painted).geometry_hash(), hash);
  EXPECT_NE(make_patches(moved).geometry_hash(), hash);
  EXPECT_NE(make_patches(scene, {.patches = 24}).geometry_hash(), hash);
}

TEST(LimitReflectance, ScalesTheWholeColour) {
  Scene scene = single({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.materials[0] = {"snow", Color(1, 0.8, 0.5), Color::Zero()};
  PatchMesh mesh = make_patches(scene);
  limit_reflectance(mesh, 0.9);
  EXPECT_TRUE(mesh.reflectance.row(0).isApprox(Eigen::RowVector3d(0.9, 0.72, 0.45)));
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_NE(mesh.notes[0].find("snow"), std::string::npos);
  EXPECT_NO_THROW(limit_reflectance(mesh, 0));
}

TEST(LimitReflectance, NamesThePatchThatReflectsAll) {
  Scene scene = single({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.materials[0] = {"mirror", Color::Ones(), Color::Zero()};
  PatchMesh mesh = make_patches(scene);
  try {
    limit_reflectance(mesh, 0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("patch 0 of material 'mirror'"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(limit_reflectance(mesh, 1), UsageError);
  EXPECT_THROW(limit_reflectance(mesh, -0.5), UsageError);
}

}  // namespace
}  // namespace radiosity
