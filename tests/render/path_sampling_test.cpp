#include "render/path_sampling.hpp"
#include "rooms.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

using namespace test;

TEST(PathSampling, PointsAreUniformOnAPatch) {
  // A quad of unequal halves: the mean of a uniform distribution is the centroid, and each half gets its
  // share.
  Scene scene;
  scene.materials.emplace_back();
  scene.groups = {"quad"};
  scene.vertices = {{0, 0, 1}, {4, 0, 1}, {3, 2, 1}, {0, 1, 1}};
  scene.faces = {{{0, 1, 2, 3}, 4, 0, 0}};
  const PatchMesh mesh = make_patches(scene);
  ASSERT_EQ(mesh.patch_count(), 1);
  RandomStream random(3);
  constexpr int count = 40000;
  Vector3 mean = Vector3::Zero();
  int first_half = 0;
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform();
    const double v = random.uniform();
    const Vector3 point = point_on_patch(mesh, 0, u, v);
    mean += point / count;
    first_half += point.y() < point.x() * 2 / 3 ? 1 : 0;  // the triangle (0, 1, 2) has area 4, the other 1.5
  }
  EXPECT_LT((mean - mesh.centroid.col(0)).norm(), 0.02);
  EXPECT_NEAR(first_half / static_cast<double>(count), 4 / 5.5, 0.01);
}

TEST(PathSampling, DirectionsFollowTheCosine) {
  const Vector3 normal = Vector3(1, -2, 0.5).normalized();
  RandomStream random(5);
  constexpr int count = 40000;
  double mean = 0;    // of the cosine: 2/3
  double square = 0;  // of its square: 1/2
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < count; ++k) {
    const double u = random.uniform();
    const double v = random.uniform();
    const Vector3 direction = cosine_direction(normal, u, v);
    const double cosine = direction.dot(normal);
    ASSERT_NEAR(direction.norm(), 1, 1e-12);
    ASSERT_GT(cosine, 0);
    mean += cosine / count;
    square += cosine * cosine / count;
    sum += direction / count;
  }
  EXPECT_NEAR(mean, 2.0 / 3, 0.006);
  EXPECT_NEAR(square, 0.5, 0.006);
  EXPECT_LT((sum - normal * 2 / 3).norm(), 0.02);  // no direction about the normal is preferred
}

TEST(PathSampling, EmittersArePickedByPower) {
  PatchMesh mesh = make_patches(box_room({1, 1, 3}));
  mesh.emission.setZero();
  mesh.emission(2, 0) = 1;  // area 3
  mesh.emission(5, 0) = 6;  // area 1
  const EmitterTable table(mesh);
  ASSERT_FALSE(table.empty());
  EXPECT_EQ(table.pick(0), 2);
  EXPECT_EQ(table.pick(0.333), 2);
  EXPECT_EQ(table.pick(0.334), 5);
  EXPECT_EQ(table.pick(0.999999), 5);
  EXPECT_DOUBLE_EQ(table.density(2), 1.0 / 9);
  EXPECT_DOUBLE_EQ(table.density(5), 6.0 / 9);
  EXPECT_EQ(table.density(0), 0);
  // Densities integrate to one over all emitters.
  double total = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) total += table.density(i) * mesh.area[i];
  EXPECT_NEAR(total, 1, 1e-12);
}

TEST(PathSampling, DarkScenesHaveNoEmitters) {
  PatchMesh mesh = make_patches(box_room({1, 1, 1}));
  EXPECT_TRUE(EmitterTable(mesh).empty());
}

}  // namespace
}  // namespace radiosity
