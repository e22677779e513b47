#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

double longest_over_shortest_edge(const PatchMesh& mesh, Index patch) {
  double longest = 0, shortest = 1e300;
  const int corners = mesh.patches[static_cast<std::size_t>(patch)].corner_count;
  for (int k = 0; k < corners; ++k) {
    const double length = (mesh.corner(patch, (k + 1) % corners) - mesh.corner(patch, k)).norm();
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
  }
  return longest / shortest;
}

TEST(Wedge, HasItsAngleBetweenTheFronts) {
  for (const double angle : {1.0, 45.0, 90.0, 179.0}) {
    const PatchMesh mesh = make_patches(built_in_scene("wedge:angle=" + std::to_string(angle)));
    ASSERT_EQ(mesh.patch_count(), 2);
    EXPECT_NEAR(mesh.area[0], 1, 1e-14);
    EXPECT_NEAR(mesh.area[1], 1, 1e-14);
    const double turn = std::acos(mesh.normal.col(0).dot(mesh.normal.col(1))) / std::numbers::pi * 180;
    EXPECT_NEAR(turn, 180 - angle, 1e-9);
    for (const int i : {0, 1})  // each in front of the other
      EXPECT_GT(mesh.normal.col(i).dot(mesh.centroid.col(1 - i) - mesh.centroid.col(i)), 0) << angle;
  }
}

TEST(FacingPlates, SeeEachOther) {
  const PatchMesh mesh = make_patches(built_in_scene("facing-plates:distance=3"), {.patches = 8});
  EXPECT_EQ(mesh.patch_count(), 8);
  for (Index i = 0; i < 8; ++i) {
    EXPECT_NEAR(mesh.normal(1, i), group_name(mesh, i) == "plate" ? 1 : -1, 1e-15);
    EXPECT_NEAR(mesh.centroid(1, i), group_name(mesh, i) == "plate" ? 0 : 3, 1e-15);
  }
}

TEST(OpenBox, IsTheCubeWithoutItsCeiling) {
  Scene scene = built_in_scene("open-box");
  EXPECT_FALSE(topology(scene).closed);
  EXPECT_NEAR(make_patches(scene, {.patches = 500}).area.sum(), 5, 1e-12);
  const Scene cube = built_in_scene("cube");
  Face ceiling = cube.faces[1];
  for (int k = 0; k < 4; ++k) {
    scene.vertices.push_back(corner(cube, cube.faces[1], k));
    ceiling.corners[static_cast<std::size_t>(k)] = static_cast<int>(scene.vertices.size()) - 1;
  }
  ceiling.group = ceiling.material = 0;
  scene.faces.push_back(ceiling);
  EXPECT_TRUE(topology(scene).enclosure);
}

TEST(IsolatedPatch, HasNothingInFrontOfItAndNoFrontTowardsIt) {
  const PatchMesh mesh = make_patches(built_in_scene("isolated-patch"));
  const Index isolated = mesh.patch_count() - 1;
  ASSERT_EQ(group_name(mesh, isolated), "isolated");
  for (const Vector3& vertex : mesh.vertices)
    EXPECT_LE(mesh.normal.col(isolated).dot(vertex - mesh.centroid.col(isolated)), 1e-15);
  EXPECT_EQ(mesh.emission(isolated, 0), 1);
}

TEST(Flat, GivesExactlyAsManyPatchesAsWanted) {
  for (const Index n : {1, 2, 3, 5, 17, 33, 600}) {
    const PatchMesh mesh = make_patches(built_in_scene("flat"), {.patches = n});
    EXPECT_EQ(mesh.patch_count(), n);
    EXPECT_NEAR(mesh.area.sum(), 0.5, 1e-14);
    EXPECT_TRUE((mesh.normal.row(1).array() == 1).all());
  }
}

TEST(Slivers, HaveTheAspectsAskedForInAWatertightRoom) {
  for (const double aspect : {2.0, 1e3, 1e6}) {
    const PatchMesh mesh = make_patches(built_in_scene("slivers:aspect=" + std::to_string(aspect)));
    EXPECT_TRUE(mesh.topology.enclosure);
    EXPECT_NEAR(mesh.area.sum(), 6, 1e-12);
    EXPECT_EQ(unmatched_edges(mesh), 0);
    double most = 0;
    for (Index i = 0; i < mesh.patch_count(); ++i)
      if (group_name(mesh, i) == "slivers") most = std::max(most, longest_over_shortest_edge(mesh, i));
    EXPECT_NEAR(most / std::max(aspect, 1e3), 1, 1e-9);
  }
}

TEST(FlawedRoom, IsReportedFlawByFlaw) {
  Scene scene = built_in_scene("flawed-room");
  const PatchMesh mesh = make_patches(scene);
  EXPECT_FALSE(mesh.topology.closed);
  ASSERT_EQ(mesh.notes.size(), 2U);
  EXPECT_EQ(mesh.notes[0], "1 faces of zero area dropped, the first is face 6");
  EXPECT_EQ(mesh.notes[1], "1 faces are there twice and kept, the first is face 7");
  EXPECT_FALSE(area_by_group(mesh).contains("zero-area"));
  EXPECT_NEAR(area_by_group(mesh)["duplicate"], 1, 1e-15);
}

// Nothing but its flaws keeps the room from being a closed one.
TEST(FlawedRoom, IsARoomOnceItIsRepaired) {
  Scene scene = built_in_scene("flawed-room");
  scene.faces.resize(7);  // without duplicate and fin
  EXPECT_FALSE(topology(scene).closed);
  std::reverse(scene.faces[3].corners.begin(), scene.faces[3].corners.end());
  EXPECT_TRUE(topology(scene).enclosure);
}

TEST(UnevenAreas, SpansTwelveOrdersInAreaInAWatertightRoom) {
  const PatchMesh mesh = make_patches(built_in_scene("uneven-areas"));
  EXPECT_NEAR(mesh.area.minCoeff(), 1e-6, 1e-16);
  EXPECT_NEAR(mesh.area.maxCoeff(), 1e6, 1e-6);
  EXPECT_NEAR(mesh.reflectance.minCoeff(), 0.01, 1e-15);
  EXPECT_NEAR(mesh.reflectance.maxCoeff(), 0.999, 1e-15);
  EXPECT_TRUE(mesh.topology.enclosure);
  double solid = 0;
  for (int step = 0; step < 6; ++step) solid += std::pow(10, 3 * (step - 3));
  EXPECT_NEAR(mesh.topology.volume / -(1e9 - solid), 1, 1e-12);
}

TEST(UnevenAreas, NestsCubesThatDoNotTouch) {
  const Scene scene = built_in_scene("uneven-areas");
  std::vector<Eigen::AlignedBox3d> boxes(6);
  for (const Face& face : scene.faces)
    if (face.group < 6)
      for (int k = 0; k < 4; ++k) boxes[static_cast<std::size_t>(face.group)].extend(corner(scene, face, k));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].intersects(boxes[k])) << i << " " << k;
}

}  // namespace
}  // namespace radiosity
