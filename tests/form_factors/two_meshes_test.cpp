// Form factors between the elements of one mesh and the patches of another, and coarse meshes made for them.

#include "form_factors/coherent_mesh.hpp"
#include "form_factors/element_factors.hpp"
#include "form_factors/patch_sums.hpp"
#include "form_factors/scene_views.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <set>

namespace radiosity {
namespace {

std::shared_ptr<const PatchMesh> mesh_of(const char* scene, Index patches) {
  return std::make_shared<const PatchMesh>(make_patches(built_in_scene(scene), {.patches = patches}));
}

FormFactors factors_of(const std::shared_ptr<const PatchMesh>& mesh) {
  SilentMonitor monitor;
  return compute_form_factors(mesh, {.closure = Closure::none}, monitor);
}

Eigen::MatrixXd direct_factors(const PatchMesh& elements, const PatchMesh& patches,
                               const std::vector<Index>& order, double tolerance) {
  Eigen::MatrixXd all(elements.patch_count(), patches.patch_count());
  SilentMonitor monitor;
  compute_element_factors(
      elements, order, patches, {.tolerance = tolerance},
      [&](Index first, const Eigen::MatrixXd& factors) { all.middleRows(first, factors.rows()) = factors; },
      monitor);
  return all;
}

std::vector<Index> mesh_order(const PatchMesh& mesh) {
  std::vector<Index> order(mesh.patches.size());
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

TEST(PatchSums, AreSumsOfEntries) {
  SilentMonitor monitor;
  for (const FormFactorMethod method : {FormFactorMethod::accurate, FormFactorMethod::gather}) {
    const FormFactors F = compute_form_factors(mesh_of("clutter", 300), {.method = method}, monitor);
    const Index n = F.patch_count();
    std::vector<int> patch_of_element(static_cast<std::size_t>(n));
    Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(n, 7);
    for (Index e = 0; e < n; ++e) {
      patch_of_element[static_cast<std::size_t>(e)] = static_cast<int>((e * e + e / 3) % 7);
      indicator(e, patch_of_element[static_cast<std::size_t>(e)]) = 1;
    }
    const Eigen::MatrixXd expected = F.matrix() * indicator;
    EXPECT_LE((patch_sums(F, patch_of_element, 7) - expected).cwiseAbs().maxCoeff(), 1e-14);
    patch_of_element[5] = 7;
    EXPECT_THROW(patch_sums(F, patch_of_element, 7), UsageError);
  }
}

TEST(ElementFactors, AreComputedWhereTheyAreWanted) {
  const auto elements = mesh_of("clutter", 400);
  const PatchMesh patches = coarsest_patches(*elements);
  const std::vector<Index> order = mesh_order(*elements);
  const Eigen::MatrixXd all = direct_factors(*elements, patches, order, 1e-2);
  const auto wanted = [](Index e, Index p) { return e % 7 == 0 && p % 2 == 1; };
  Eigen::MatrixXd some = Eigen::MatrixXd::Constant(all.rows(), all.cols(), -1);
  SilentMonitor monitor;
  const std::uint64_t rays = compute_element_factors(
      *elements, order, patches, {.tolerance = 1e-2, .wanted = wanted},
      [&](Index first, const Eigen::MatrixXd& rows) { some.middleRows(first, rows.rows()) = rows; }, monitor);
  EXPECT_GT(rays, 0);
  for (Index p = 0; p < all.cols(); ++p)
    for (Index e = 0; e < all.rows(); ++e) EXPECT_EQ(some(e, p), wanted(e, p) ? all(e, p) : 0);
}

TEST(ElementFactors, OfAConvexSceneAreTheSumsOfItsForm) {
  const auto elements = mesh_of("cube", 864);
  const auto coarse = uniform_coarse_mesh(*elements, 54, Assignment::inclusion);
  ASSERT_TRUE(coarse);
  const Eigen::MatrixXd sums = patch_sums(factors_of(elements), coarse->patch_of_element, 54);
  const Eigen::MatrixXd direct = direct_factors(*elements, coarse->patches, mesh_order(*elements), 1e-4);
  EXPECT_LE((direct - sums).cwiseAbs().maxCoeff(), 1e-5);
  // Patches that elements do not belong to must not fit.
  const auto other = uniform_coarse_mesh(*elements, 24, Assignment::inclusion);
  EXPECT_GT((direct_factors(*elements, other->patches, mesh_order(*elements), 1e-4).leftCols(24) -
             sums.leftCols(24))
                .cwiseAbs()
                .maxCoeff(),
            1e-2);
}

TEST(ElementFactors, OfABlockedSceneAreTheSumsWithinTheTolerance) {
  const auto elements = mesh_of("clutter", 500);
  const auto coarse = coherent_coarse_mesh(*elements, 100, Assignment::inclusion);
  ASSERT_TRUE(coarse);
  const Eigen::MatrixXd sums =
      patch_sums(factors_of(elements), coarse->patch_of_element, coarse->patches.patch_count());
  constexpr double tolerance = 1e-3;
  const Eigen::MatrixXd difference =
      direct_factors(*elements, coarse->patches, mesh_order(*elements), tolerance) - sums;
  const double rms = std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size()));
  EXPECT_LE(rms, tolerance);
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), 10 * tolerance);
}

TEST(ElementFactors, ComeInTheOrderAskedForFromAnyNumberOfThreads) {
  const auto elements = mesh_of("clutter", 200);
  const auto coarse = coherent_coarse_mesh(*elements, 100, Assignment::inclusion);
  ASSERT_TRUE(coarse);
  std::vector<Index> order = mesh_order(*elements);
  std::reverse(order.begin(), order.end());
  const Eigen::MatrixXd reversed = direct_factors(*elements, coarse->patches, order, 1e-3);
  for (const int threads : {1, 8}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(direct_factors(*elements, coarse->patches, order, 1e-3), reversed);
  }
  const Eigen::MatrixXd forward =
      direct_factors(*elements, coarse->patches, mesh_order(*elements), 1e-3).colwise().reverse();
  EXPECT_LE((forward - reversed).cwiseAbs().maxCoeff(), 1e-2);
}

TEST(SceneViews, DifferByWhatIsSeenNotByHowItIsCut) {
  const auto cube = mesh_of("cube", 6);
  const SceneViews views(*cube, 1024, 1);
  const Vector3 up = Vector3::UnitY();
  const SceneView middle = views.from({0.5, 0, 0.5}, up);
  EXPECT_EQ(views.difference(middle, middle), 0);
  EXPECT_EQ(views.difference(middle, views.from({0.5, 0, 0.5}, up)), 0);
  const double near = views.difference(middle, views.from({0.55, 0, 0.5}, up));
  const double far = views.difference(middle, views.from({0.95, 0, 0.5}, up));
  EXPECT_GT(near, 0);
  EXPECT_GT(far, 4 * near);
  EXPECT_LE(far, 1);
  // A sphere of many facets: neighbouring facets count as one surface.
  const auto sphere = mesh_of("sphere-cavity:rings=24", 1152);
  const SceneViews inside(*sphere, 1024, 1);
  EXPECT_LT(inside.difference(inside.from({0.9, 0, 0}, {-1, 0, 0}), inside.from({0.9, 0.02, 0}, {-1, 0, 0})),
            0.02);
  EXPECT_THROW(SceneViews(*cube, 20, 1), UsageError);
}

TEST(CoherentMesh, KeepsToItsLimitsAndCutsBetweenElements) {
  const auto elements = mesh_of("cornell-box-closed", 3300);
  for (const Index k : {50, 206}) {
    const auto coarse = coherent_coarse_mesh(*elements, k, Assignment::inclusion);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->patches.patch_count(), k);
    EXPECT_EQ(std::set<int>(coarse->patch_of_element.begin(), coarse->patch_of_element.end()).size(),
              static_cast<std::size_t>(k));
  }
  const auto few = coherent_coarse_mesh(*elements, 300, Assignment::inclusion, {.threshold = 0.5});
  EXPECT_LT(few->patches.patch_count(), 300);
  const auto large = coherent_coarse_mesh(*elements, 300, Assignment::inclusion, {.least_area = 0.02});
  EXPECT_LT(large->patches.patch_count(), 300);
  EXPECT_FALSE(coherent_coarse_mesh(*elements, 5, Assignment::inclusion));
}

TEST(CoherentMesh, IsFinerWhereViewsChange) {
  // Near the edges of a cube views change fastest.
  const auto elements = mesh_of("cube", 3456);
  const auto coarse = coherent_coarse_mesh(*elements, 100, Assignment::inclusion);
  double inner = 0, outer = 0;
  int inner_count = 0, outer_count = 0;
  for (Index p = 0; p < coarse->patches.patch_count(); ++p) {
    const Vector3 from_centre = coarse->patches.centroid.col(p) - Vector3::Constant(0.5);
    Vector3 sorted = from_centre.cwiseAbs();
    std::sort(sorted.begin(), sorted.end());
    const bool at_edge = sorted[1] > 0.3;
    (at_edge ? outer : inner) += coarse->patches.area[p];
    ++(at_edge ? outer_count : inner_count);
  }
  EXPECT_LT(outer / outer_count, inner / inner_count);
}

}  // namespace
}  // namespace radiosity
