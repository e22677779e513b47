#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/scene_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity {
namespace {

/// A truncated pyramid from outside: the base has four times the side of the top.
Scene frustum() {
  SceneBuilder builder("frustum");
  const int grey = builder.material({});
  const int group = builder.group("frustum");
  const std::vector<Vector3> base = {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}};
  std::vector<Vector3> top;
  top.reserve(base.size());
  for (const Vector3& corner : base) top.emplace_back(corner.x() / 4, 1, corner.z() / 4);
  builder.face({base[3], base[2], base[1], base[0]}, grey, group);
  builder.face(top, grey, group);
  for (std::size_t k = 0; k < 4; ++k)
    builder.face({base[k], base[(k + 1) % 4], top[(k + 1) % 4], top[k]}, grey, group);
  Scene scene = std::move(builder.scene());
  scene.conforming = true;
  return scene;
}

TEST(ConformingCells, LeaveNoTJunctionsBetweenFacesOfDifferentSize) {
  for (const Index patches : {6, 50, 333, 2000}) {
    const PatchMesh mesh = make_patches(frustum(), {.patches = patches});
    EXPECT_EQ(unmatched_edges(mesh), 0) << patches;
    EXPECT_NEAR(mesh.area.sum(), 16 + 1 + 4 * 2.5 * std::hypot(1, 1.5), 1e-11);
  }
}

// The check can fail: cut face by face, the small top does not fit to the sides.
TEST(ConformingCells, AreNeededForThat) {
  Scene scene = frustum();
  scene.conforming = false;
  EXPECT_GT(unmatched_edges(make_patches(scene, {.patches = 333})), 0);
}

TEST(ConformingCells, DoNotExceedTheWantedNumber) {
  const Scene scene = built_in_scene("rooms:n=10,door=0.2");
  for (const Index wanted : {238, 300, 600, 1000, 3300, 10000}) {
    const Index count = make_patches(scene, {.patches = wanted}).patch_count();
    EXPECT_LE(count, wanted);
    EXPECT_GE(static_cast<double>(count), 0.95 * static_cast<double>(wanted)) << wanted;
  }
}

TEST(ConformingCells, KeepCellsOfSimilarLength) {
  const PatchMesh mesh = make_patches(built_in_scene("rooms:n=5,door=0.3"), {.patches = 3300});
  double longest = 0, largest = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    largest = std::max(largest, mesh.area[i]);
    for (int k = 0; k < 4; ++k)
      longest = std::max(longest, (mesh.corner(i, (k + 1) % 4) - mesh.corner(i, k)).norm());
  }
  const double even = std::sqrt(mesh.area.sum() / static_cast<double>(mesh.patch_count()));
  EXPECT_LT(longest, 1.6 * even);
  EXPECT_LT(largest, 2 * even * even);
}

}  // namespace
}  // namespace radiosity
