#include "scene/built_in.hpp"
#include "scene/coarse_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace radiosity {
namespace {

PatchMesh mesh_of(const char* scene, Index patches) {
  return make_patches(built_in_scene(scene), {.patches = patches});
}

Eigen::VectorXd element_areas_by_patch(const PatchMesh& elements, const CoarseMesh& coarse) {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(coarse.patches.patch_count());
  for (Index e = 0; e < elements.patch_count(); ++e)
    area[coarse.patch_of_element[static_cast<std::size_t>(e)]] += elements.area[e];
  return area;
}

TEST(CoarseMesh, OfTheCubeHasSixteenElementsAPatch) {
  const PatchMesh elements = mesh_of("cube", 3456);
  for (const Assignment assignment : {Assignment::inclusion, Assignment::proximity}) {
    const auto coarse = uniform_coarse_mesh(elements, 216, assignment);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->patches.patch_count(), 216);
    EXPECT_TRUE(element_areas_by_patch(elements, *coarse).isApprox(coarse->patches.area, 1e-12));
  }
}

TEST(CoarseMesh, ElementsLieOnTheFaceOfTheirPatchAndEveryPatchHasSome) {
  for (const char* scene : {"cornell-box-closed", "clutter", "patio", "sphere-cavity"}) {
    const PatchMesh elements = mesh_of(scene, 2000);
    const auto coarse = uniform_coarse_mesh(elements, 700, Assignment::inclusion);
    ASSERT_TRUE(coarse) << scene;
    EXPECT_LE(coarse->patches.patch_count(), 700);
    EXPECT_GT(element_areas_by_patch(elements, *coarse).minCoeff(), 0) << scene;
    for (std::size_t e = 0; e < elements.patches.size(); ++e)
      EXPECT_EQ(elements.patches[e].face,
                coarse->patches.patches[static_cast<std::size_t>(coarse->patch_of_element[e])].face);
  }
}

TEST(CoarseMesh, IsTheElementsWhereTheyAreFewAndNothingWhereFacesAreMany) {
  const PatchMesh elements = mesh_of("cube", 54);
  const auto same = uniform_coarse_mesh(elements, 54, Assignment::inclusion);
  ASSERT_TRUE(same);
  std::vector<int> each(54);
  std::iota(each.begin(), each.end(), 0);
  EXPECT_EQ(same->patch_of_element, each);
  EXPECT_FALSE(uniform_coarse_mesh(mesh_of("sphere-cavity", 1000), 50, Assignment::inclusion));
}

TEST(CoarseMesh, CutsQuadsAndTrianglesWhereTheyShould) {
  const Polygon quad = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  ASSERT_EQ(longer_edges(quad), 0U);
  const auto [before, after] = cut_quad(quad, 0, 0.25);
  EXPECT_NEAR(area_vector(before).z(), 0.5, 1e-15);
  EXPECT_NEAR(area_vector(after).z(), 1.5, 1e-15);
  EXPECT_TRUE(contains(before, {0.4, 0.5, 0}, Vector3::UnitZ(), 1e-9));
  EXPECT_FALSE(contains(before, {0.6, 0.5, 0}, Vector3::UnitZ(), 1e-9));
  const auto [left, right] = cut_quad(quad, 1, 0.5);
  EXPECT_NEAR(area_vector(left).z(), 1, 1e-15);
  EXPECT_NEAR(area_vector(right).z(), 1, 1e-15);
  const auto [first, second] = halve_triangle({{0, 0, 0}, {3, 0, 0}, {0, 1, 0}});
  EXPECT_NEAR(area_vector(first).z(), 0.75, 1e-15);
  EXPECT_NEAR(area_vector(second).z(), 0.75, 1e-15);
}

}  // namespace
}  // namespace radiosity
