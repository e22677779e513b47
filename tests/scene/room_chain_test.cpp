#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace radiosity {
namespace {

constexpr double kThickness = 0.05;

struct ChainCase {
  const char* spec;
  int rooms;
  int doors;  // open ones
  double width, height;
};

const std::vector<ChainCase> kChains = {{"rooms", 2, 1, 0.3, 0.3},
                                        {"rooms:n=1", 1, 0, 0, 0},
                                        {"rooms:n=5,door=0.3", 5, 4, 0.3, 0.3},
                                        {"rooms:n=3,door=1", 3, 2, 1, 1},
                                        {"rooms:n=4,door=0", 4, 0, 0, 0},
                                        {"rooms:n=4,door=0.001,closed=3", 4, 2, 0.001, 0.001},
                                        {"rooms:n=2,door=0.4,closed=1", 2, 0, 0.4, 0.4},
                                        {"rooms:n=64,door=0.5", 64, 63, 0.5, 0.5},
                                        {"keyhole", 2, 1, 0.02, 0.1},
                                        {"keyhole:width=1,height=0.001", 2, 1, 1, 0.001},
                                        {"disconnected-rooms:n=3", 3, 0, 0, 0}};

TEST(RoomChain, IsWatertightWithTheAreaAndVolumeOfItsRoomsAndDoors) {
  for (const ChainCase& chain : kChains) {
    const PatchMesh mesh = make_patches(built_in_scene(chain.spec));
    EXPECT_TRUE(mesh.topology.enclosure) << chain.spec;
    const double opening = chain.width * chain.height;
    const double jambs = 2 * (chain.width + chain.height) * kThickness;
    EXPECT_NEAR(mesh.area.sum(), 6 * chain.rooms + chain.doors * (jambs - 2 * opening), 1e-11) << chain.spec;
    EXPECT_NEAR(mesh.topology.volume, -(chain.rooms + chain.doors * opening * kThickness), 1e-11)
        << chain.spec;
  }
}

TEST(RoomChain, HasNoTJunctionsHoweverItIsCut) {
  for (const ChainCase& chain : kChains)
    for (const Subdivision& cut : {Subdivision{}, {.patches = 2000}, {.edge = 0.3}})
      EXPECT_EQ(unmatched_edges(make_patches(built_in_scene(chain.spec), cut)), 0) << chain.spec;
}

// The checks can fail: without one side of its doorway, or with it facing the other way, the chain is open.
TEST(RoomChain, IsNotClosedWithoutAJamb) {
  Scene scene = built_in_scene("rooms");
  const auto jamb = std::find_if(scene.faces.begin(), scene.faces.end(), [&](const Face& face) {
    return scene.groups[static_cast<std::size_t>(face.group)] == "room1/door";
  });
  ASSERT_NE(jamb, scene.faces.end());
  Scene without = scene;
  without.faces.erase(without.faces.begin() + (jamb - scene.faces.begin()));
  EXPECT_FALSE(topology(without).closed);
  std::reverse(jamb->corners.begin(), jamb->corners.end());
  EXPECT_FALSE(topology(scene).closed);
  EXPECT_GT(unmatched_edges(make_patches(scene)), 0);
}

TEST(RoomChain, NamesGroupsByRoom) {
  const PatchMesh mesh = make_patches(built_in_scene("rooms:n=5,door=0.25"));
  std::set<std::string> rooms;
  for (const std::string& group : mesh.scene->groups) rooms.insert(room_of_group(group));
  EXPECT_EQ(rooms, (std::set<std::string>{"room1", "room2", "room3", "room4", "room5"}));
  auto areas = area_by_group(mesh);
  for (const std::string room : {"room1", "room3", "room5"}) {
    EXPECT_NEAR(areas[room + "/floor"], 1, 1e-13);
    EXPECT_NEAR(areas[room + "/ceiling"], 1, 1e-13);
    EXPECT_NEAR(areas[room + "/walls"], 4 - (room == "room3" ? 2 : 1) * 0.25 * 0.25, 1e-13);
  }
  EXPECT_NEAR(areas["room4/door"], 4 * 0.25 * kThickness, 1e-13);
  EXPECT_FALSE(areas.contains("room5/door"));
  EXPECT_EQ(room_of_group("walls"), "walls");
}

TEST(RoomChain, KeepsPatchesInTheirRoomAndLightsTheFirst) {
  const PatchMesh mesh = make_patches(built_in_scene("rooms:n=3,reflectance=0.99"), {.patches = 500});
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const std::string& group = group_name(mesh, i);
    const double begin = (std::stoi(group.substr(4)) - 1) * (1 + kThickness);
    const double x = mesh.centroid(0, i) - begin;
    const bool door = group.ends_with("/door");
    EXPECT_TRUE(door ? x > 1 && x < 1 + kThickness : x >= 0 && x <= 1) << group;
    EXPECT_EQ(mesh.emission(i, 0), group == "room1/ceiling" ? 1 : 0);
    EXPECT_EQ(mesh.reflectance(i, 0), 0.99);
  }
}

TEST(RoomChain, ClosesTheDoorThatIsNamed) {
  auto areas = area_by_group(make_patches(built_in_scene("rooms:n=4,closed=2")));
  EXPECT_TRUE(areas.contains("room1/door") && areas.contains("room3/door"));
  EXPECT_FALSE(areas.contains("room2/door"));
  EXPECT_NEAR(areas["room2/walls"], 4 - 0.09, 1e-13);
}

TEST(LRoom, IsWatertightAndLitAtOneEnd) {
  const PatchMesh mesh = make_patches(built_in_scene("l-room"), {.patches = 600});
  EXPECT_TRUE(mesh.topology.enclosure);
  EXPECT_FALSE(mesh.topology.convex);
  const double base = 2.2 * 2 - 1.2 * 1.2;
  EXPECT_NEAR(mesh.topology.volume, -base * 0.9, 1e-12);
  EXPECT_NEAR(mesh.area.sum(), 2 * base + 2 * (2.2 + 2) * 0.9, 1e-12);
  EXPECT_EQ(unmatched_edges(mesh), 0);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    EXPECT_EQ(mesh.emission(i, 0), group_name(mesh, i) == "light" ? 1 : 0);
    EXPECT_TRUE(!(group_name(mesh, i) == "light") || mesh.centroid(0, i) > 1);
  }
  EXPECT_NEAR(area_by_group(mesh)["light"], 1.2 * 0.8, 1e-13);
}

}  // namespace
}  // namespace radiosity
