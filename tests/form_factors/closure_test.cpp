#include "form_factors/closure.hpp"
#include "scene/built_in.hpp"
#include "tests/form_factors/hand_made_scenes.hpp"

#include <gtest/gtest.h>

namespace radiosity::testing {
namespace {

std::shared_ptr<const PatchMesh> room(const char* name, Index patches) {
  return std::make_shared<const PatchMesh>(make_patches(built_in_scene(name), {.patches = patches}));
}

TEST(Closure, AnEnclosureIsClosedByDefault) {
  const auto mesh = room("cornell-box-closed", 500);
  const FormFactors form_factors = compute(mesh);
  EXPECT_EQ(form_factors.quality.closure, "symmetric");
  EXPECT_LE(form_factors.quality.row_sum_rms, 1e-10);
  EXPECT_LE((form_factors.row_sums().array() - 1).abs().maxCoeff(), 1e-10);
  EXPECT_EQ(form_factors.quality.reciprocity_max, 0);
  EXPECT_GT(compute(mesh, raw()).quality.row_sum_rms, 1e-10);  // so there was something to close
}

TEST(Closure, AnOpenSceneIsNot) {
  const FormFactors form_factors = compute(room("cornell-box", 300));
  EXPECT_EQ(form_factors.quality.closure, "none");
  EXPECT_LT(form_factors.quality.row_sum_min, 0.9);
}

TEST(Closure, AnOpenSceneAimsAtItsExposedFractions) {
  const auto mesh = room("cornell-box", 300);
  FormFactorOptions options;
  options.closure = Closure::symmetric;
  const FormFactors form_factors = compute(mesh, options);
  EXPECT_EQ(form_factors.quality.closure, "symmetric");
  EXPECT_LE((form_factors.row_sums() - form_factors.exposed).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LE(form_factors.row_sums().maxCoeff(), 1 + 1e-12);
}

// K1: two facing plates are bipartite with unequal areas, no D exists.
TEST(Closure, WhereScalingDoesNotExistEnergyIsOnlyRemoved) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, 0.2}, 2 * kY, 2 * kX);
  const auto mesh = scene.mesh();
  FormFactors form_factors = compute(mesh, raw());
  SymmetricTiles<double> kernel(2, [](Index, Index) { return true; });
  kernel.set(0, 1, (*form_factors.kernel)(0, 1));
  const Eigen::VectorXd target = Eigen::VectorXd::Constant(2, 0.2);
  const ClosureResult result = close_symmetric(kernel, mesh->area, target);
  EXPECT_EQ(result.kind, "energy-removing");
  EXPECT_FALSE(result.note.empty());
  const double ratio = kernel(0, 1) / (*form_factors.kernel)(0, 1);
  EXPECT_LE(ratio, 1);
  EXPECT_LE(form_factors(0, 1) * ratio, target[0] + 1e-12);
}

TEST(Closure, ScalingIsFoundAndRowsThatAreNotLiveAreLeftAlone) {
  const Index n = 130;
  SymmetricTiles<double> kernel(n, [](Index, Index) { return true; });
  for (Index i = 0; i + 1 < n; ++i)
    for (Index j = 0; j <= i; ++j)
      kernel.set(i, j, (1 + 0.3 * std::sin(static_cast<double>(i + j))) / static_cast<double>(n));
  Eigen::VectorXd target = Eigen::VectorXd::Ones(n);
  target[n - 1] = 0;
  EXPECT_EQ(close_symmetric(kernel, Eigen::VectorXd::Ones(n), target).kind, "symmetric");
  const Eigen::VectorXd sums = materialize(kernel).rowwise().sum();
  EXPECT_LE((sums - target).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace radiosity::testing
