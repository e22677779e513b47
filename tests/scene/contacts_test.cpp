#include "foundation/random.hpp"
#include "scene/built_in.hpp"
#include "scene/contacts.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/polygon.hpp"
#include "scene/scene_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace radiosity {
namespace {

/// A floor [0, 4]^2 at y = 0 with a unit block on [1, 2]^2, with or without a bottom of its own.
Scene floor_and_block(bool with_bottom, bool floor_up = true) {
  SceneBuilder builder("floor and block");
  const int grey = builder.material({});
  std::vector<Vector3> floor = {{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}};
  if (!floor_up) std::reverse(floor.begin(), floor.end());
  builder.face(floor, grey, builder.group("floor"));
  const int block = builder.group("block");
  const std::vector<Vector3> bottom = {{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}};
  std::vector<Vector3> top;
  top.reserve(bottom.size());
  for (const Vector3& corner : bottom) top.push_back(corner + Vector3::UnitY());
  builder.face(top, grey, block);
  for (std::size_t k = 0; k < 4; ++k)
    builder.face({bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]}, grey, block);
  if (with_bottom) builder.face({bottom[3], bottom[2], bottom[1], bottom[0]}, grey, block);
  return builder.scene();
}

double group_area(const PatchMesh& mesh, int group) {
  double area = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    if (mesh.patches[static_cast<std::size_t>(i)].group == group) area += mesh.area[i];
  return area;
}

bool contains(const PatchMesh& mesh, Index i, const Vector3& point) {
  const int n = mesh.patches[static_cast<std::size_t>(i)].corner_count;
  if (std::abs(mesh.normal.col(i).dot(point - mesh.corner(i, 0))) > 1e-9) return false;
  for (int k = 0; k < n; ++k) {
    const Vector3 edge = mesh.corner(i, (k + 1) % n) - mesh.corner(i, k);
    if (mesh.normal.col(i).dot(edge.cross(point - mesh.corner(i, k))) < 0) return false;
  }
  return true;
}

TEST(Contacts, CutTheFootprintOutOfTheFloor) {
  for (const Index patches : {20, 100, 1000}) {
    const PatchMesh mesh = make_patches(floor_and_block(false), {.patches = patches});
    EXPECT_NEAR(group_area(mesh, 0), 16 - 1, 1e-12);
    EXPECT_NEAR(group_area(mesh, 1), 5, 1e-12);
  }
}

TEST(Contacts, CutBottomAndFloorAlike) {
  const PatchMesh mesh = make_patches(floor_and_block(true), {.patches = 200});
  EXPECT_NEAR(group_area(mesh, 0), 16 - 1, 1e-12);
  EXPECT_NEAR(group_area(mesh, 1), 5, 1e-12);
}

TEST(Contacts, LeaveAFloorThatLooksAwayAlone) {
  EXPECT_NEAR(group_area(make_patches(floor_and_block(false, false), {.patches = 100}), 0), 16, 1e-12);
  EXPECT_NEAR(group_area(make_patches(floor_and_block(true, false), {.patches = 100}), 0), 16, 1e-12);
}

TEST(Contacts, KeepOnePatchAFaceWithoutSubdivisionAndSaySo) {
  const PatchMesh mesh = make_patches(floor_and_block(false));
  EXPECT_EQ(mesh.patch_count(), 6);
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_NE(mesh.notes.front().find("1 faces are partly covered"), std::string::npos) << mesh.notes.front();
}

TEST(Contacts, AreNotSeenInSheetsAndReversedTwins) {
  Scene sheet = floor_and_block(true);
  sheet.faces.resize(1);
  const Scene twins = two_sided(sheet);
  EXPECT_NEAR(make_patches(twins, {.patches = 50}).area.sum(), 32, 1e-12);
}

TEST(Contacts, AreNotSeenBetweenABlockAndAFloorItFloatsAbove) {
  Scene scene = floor_and_block(true);
  for (Vector3& vertex : scene.vertices)
    if (vertex.y() > 0 || (vertex.x() >= 1 && vertex.x() <= 2)) vertex.y() += 0.01;
  EXPECT_NEAR(group_area(make_patches(scene, {.patches = 50}), 0), 16, 1e-12);
}

TEST(Contacts, WorkAtAnyScaleAndPlace) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double offset : {0.0, 1e5}) {
      Scene scene = floor_and_block(true);
      for (Vector3& vertex : scene.vertices) vertex = scale * (vertex + Vector3::Constant(offset));
      const PatchMesh mesh = make_patches(scene, {.patches = 100});
      EXPECT_NEAR(group_area(mesh, 0) / (scale * scale), 15, 1e-8) << scale << " " << offset;
    }
}

TEST(Contacts, CutFootprintsThatAreNotConvex) {
  // An L-shaped block: three unit squares.
  SceneBuilder builder("L");
  const int grey = builder.material({});
  builder.face({{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}}, grey, builder.group("floor"));
  const std::vector<Vector3> foot = {{1, 0, 1}, {1, 0, 3}, {2, 0, 3}, {2, 0, 2}, {3, 0, 2}, {3, 0, 1}};
  for (std::size_t k = 0; k < foot.size(); ++k) {
    const Vector3 &a = foot[k], &b = foot[(k + 1) % foot.size()];
    builder.face({a, b, b + Vector3::UnitY(), a + Vector3::UnitY()}, grey, builder.group("block"));
  }
  EXPECT_NEAR(group_area(make_patches(builder.scene(), {.patches = 150}), 0), 16 - 3, 1e-12);
}

TEST(Contacts, LeaveConvexPatchesThatCoverEachFloorPointOnce) {
  const PatchMesh mesh = make_patches(built_in_scene("cornell-box-closed"), {.patches = 1000});
  const Polygon short_foot = {{.130, 0, .065}, {.082, 0, .225}, {.240, 0, .272}, {.290, 0, .114}};
  const Polygon tall_foot = {{.423, 0, .247}, {.265, 0, .296}, {.314, 0, .456}, {.472, 0, .406}};
  const auto inside = [](const Polygon& polygon, const Vector3& point) {
    for (std::size_t k = 0; k < 4; ++k)
      if ((polygon[(k + 1) % 4] - polygon[k]).cross(point - polygon[k]).y() < 0) return false;
    return true;
  };
  RandomStream random(5);
  for (int sample = 0; sample < 2000; ++sample) {
    const Vector3 point(random.uniform(0, .556), 0, random.uniform(0, .5592));
    int covering = 0;
    for (Index i = 0; i < mesh.patch_count(); ++i)
      if (mesh.scene->groups[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group)] ==
          "floor")
        covering += contains(mesh, i, point);
    EXPECT_EQ(covering, inside(short_foot, point) || inside(tall_foot, point) ? 0 : 1) << point.transpose();
  }
}

TEST(Contacts, LeavePlaneConvexPatchesWithTheNormalOfTheirFace) {
  for (const Index patches : {0, 1000, 3300}) {
    const PatchMesh mesh = make_patches(built_in_scene("cornell-box-closed"), {.patches = patches});
    for (Index i = 0; i < mesh.patch_count(); ++i) {
      const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
      Polygon polygon;
      for (int k = 0; k < patch.corner_count; ++k) polygon.push_back(mesh.corner(i, k));
      const Face& face = mesh.scene->faces[static_cast<std::size_t>(patch.face)];
      const Vector3 normal = area_vector(*mesh.scene, face).normalized();
      ASSERT_GT(mesh.area[i], 0);
      ASSERT_GT(normal.dot(mesh.normal.col(i)), 1 - 1e-9) << i;
      ASSERT_TRUE(is_convex(polygon, normal, 1e-12)) << i;
      for (const Vector3& point : polygon)
        ASSERT_NEAR(normal.dot(point - corner(*mesh.scene, face, 0)), 0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace radiosity
