#include "foundation/random.hpp"
#include "render/patch_rays.hpp"
#include "render/path_sampling.hpp"
#include "rooms.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

using namespace test;

TEST(PatchRays, NamesThePatchAndTheSide) {
  Scene scene;
  add_square(scene, 0, true, 0, 0.5);
  add_square(scene, 1, false, 0, 0.5);
  add_square(scene, 2, true, 0, 0.5);
  const PatchMesh mesh = make_patches(scene);
  const PatchRays rays(mesh);
  const PatchHit up = rays.from_patch(0, {0.25, 0.5, 0}, Vector3::UnitZ());
  EXPECT_EQ(up.patch, 1);
  EXPECT_TRUE(up.front);
  EXPECT_LT((up.point - Vector3(0.25, 0.5, 1)).norm(), 2 * rays.lift());
  EXPECT_TRUE(rays.from_patch(0, {0.5, 0.5, 0}, Vector3::UnitX()).missed());
  const PatchHit down = rays.from_patch(1, {0.25, 0.5, 1}, Vector3(0.1, 0, -1).normalized());
  EXPECT_EQ(down.patch, 0);
  EXPECT_NEAR(down.point.x(), 0.35, 1e-5);

  // From above everything: patch 2 shows its front; from below its back is looked through, as is that of 0.
  EXPECT_EQ(rays.first_front({0.5, 0.5, 9}, -Vector3::UnitZ()).patch, 2);
  EXPECT_EQ(rays.first_front({0.5, 0.5, -9}, Vector3::UnitZ()).patch, 1);

  EXPECT_FALSE(rays.blocked(0, {0.5, 0.5, 0}, 1, {0.2, 0.2, 1}));
  EXPECT_TRUE(rays.blocked(0, {0.5, 0.5, 0}, 2, {0.2, 0.2, 2}));
}

TEST(PatchRays, CoincidentTwinsShowTheirFront) {
  Scene scene;
  add_square(scene, 0, true, 0, 0.5);
  add_square(scene, 1, true, 0, 0.5);
  const PatchMesh mesh = make_patches(two_sided(scene));
  const PatchRays rays(mesh);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    if (mesh.centroid(2, i) > 0.5 || mesh.normal(2, i) < 0) continue;  // the lower square, looking up
    RandomStream random(1);
    for (int k = 0; k < 1000; ++k) {
      const double u = random.uniform();
      const double v = random.uniform();
      const PatchHit hit = rays.from_patch(i, point_on_patch(mesh, i, u, v), Vector3::UnitZ());
      ASSERT_FALSE(hit.missed());
      ASSERT_TRUE(hit.front);
      ASSERT_LT(mesh.normal(2, hit.patch), 0);
    }
  }
}

TEST(PatchRays, ClosedRoomsDoNotLeak) {
  // G6: rays from everywhere on the walls, also along edges and into corners.
  const PatchMesh mesh = make_patches(box_room({3, 1, 2}), {.patches = 294});
  const PatchRays rays(mesh);
  int leaks = 0;
  int backs = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    RandomStream random(11, static_cast<std::uint64_t>(i));
    for (int k = 0; k < 1000; ++k) {
      const double s = random.uniform();
      const double t = random.uniform();
      const Vector3 from = point_on_patch(mesh, i, s, t);
      const auto other = static_cast<Index>(random.below(static_cast<std::uint64_t>(mesh.patch_count())));
      const Vector3 apart = mesh.corner(other, static_cast<int>(random.below(4))) - from;
      if (apart.dot(mesh.normal.col(i)) < 1e-3) continue;
      const PatchHit hit = rays.from_patch(i, from, apart.normalized());  // straight at a vertex
      leaks += hit.missed() ? 1 : 0;
      backs += !hit.missed() && !hit.front ? 1 : 0;
    }
  }
  EXPECT_EQ(leaks, 0);
  EXPECT_EQ(backs, 0);
}

}  // namespace
}  // namespace radiosity
