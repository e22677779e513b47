#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

double area_of(const std::string& spec) {
  return make_patches(built_in_scene(spec)).area.sum();
}

TEST(SphereCavity, IsAWatertightConvexRoomWithCornersOnTheSphere) {
  for (const char* spec : {"sphere-cavity:rings=3", "sphere-cavity", "sphere-cavity:rings=17"}) {
    const PatchMesh mesh = make_patches(built_in_scene(spec));
    EXPECT_TRUE(mesh.topology.enclosure && mesh.topology.convex) << spec;
    EXPECT_EQ(unmatched_edges(mesh), 0) << spec;
    for (const Vector3& vertex : mesh.vertices) EXPECT_NEAR(vertex.norm(), 1, 1e-15);
  }
}

TEST(SphereCavity, HasTwoTimesTheSquareOfItsRingsInFacets) {
  for (const int rings : {3, 12, 17})
    EXPECT_EQ(make_patches(built_in_scene("sphere-cavity:rings=" + std::to_string(rings))).patch_count(),
              2 * rings * rings);
}

TEST(SphereCavity, ApproachesTheSphereWithTheSquareOfTheFacetSize) {
  const auto missing = [](int rings) {
    return 4 * std::numbers::pi - area_of("sphere-cavity:rings=" + std::to_string(rings));
  };
  EXPECT_GT(missing(12), 0);
  EXPECT_LT(missing(12), 0.2);
  EXPECT_NEAR(missing(12) / missing(24), 4, 0.1);
}

TEST(SphereCavity, EmitsAtTheTop) {
  const PatchMesh mesh = make_patches(built_in_scene("sphere-cavity"));
  for (Index i = 0; i < mesh.patch_count(); ++i)
    EXPECT_EQ(mesh.emission(i, 0), mesh.centroid(1, i) > std::numbers::sqrt2 / 2 ? 1 : 0);
}

TEST(Bowl, HasTheAreaOfTheCap) {
  for (const double beta : {1.0, 30.0, 60.0, 90.0, 150.0, 179.0}) {
    const double exact = 2 * std::numbers::pi * (1 - std::cos(beta / 180 * std::numbers::pi));
    const std::string spec = "bowl:rings=40,beta=" + std::to_string(beta);
    EXPECT_NEAR(area_of(spec) / exact, 1, 3e-3) << beta;
  }
}

TEST(Bowl, IsOpenAtTheRimOnlyAndLooksUp) {
  const PatchMesh mesh = make_patches(built_in_scene("bowl"));
  EXPECT_FALSE(mesh.topology.closed);
  EXPECT_TRUE(mesh.topology.convex);  // no facet hides another
  const double rim = -std::cos(std::numbers::pi / 3);
  int rim_edges = 0;
  for (const Patch& patch : mesh.patches)
    for (int k = 0; k < patch.corner_count; ++k) {
      const auto at = [&](int c) {
        return mesh.vertices[static_cast<std::size_t>(
            patch.corners[static_cast<std::size_t>(c % patch.corner_count)])];
      };
      rim_edges += std::abs(at(k).y() - rim) < 1e-12 && std::abs(at(k + 1).y() - rim) < 1e-12 ? 1 : 0;
    }
  EXPECT_EQ(unmatched_edges(mesh), rim_edges);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    EXPECT_GT(mesh.normal(1, i), 0);
    EXPECT_EQ(mesh.emission(i, 0), group_name(mesh, i) == "light" ? 1 : 0);
  }
  EXPECT_GT(area_by_group(mesh)["dark"], area_by_group(mesh)["light"]);
}

}  // namespace
}  // namespace radiosity
