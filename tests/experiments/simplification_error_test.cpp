#include "experiments/reference_solution.hpp"
#include "experiments/simplification_error.hpp"
#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "scene/light_transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace radiosity {
namespace {

FormFactors factors_of(const std::string& scene, Index patches) {
  SilentMonitor monitor;
  return compute_form_factors(
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(scene), {.patches = patches})),
      {.tolerance = 1e-3}, monitor);
}

TEST(SimplificationError, ShrinksWithTheNumberOfVoxels) {
  SilentMonitor monitor;
  const FormFactors F = factors_of("cornell-box-closed", 300);
  const Field B = *reference_solution(F, F.mesh->emission);
  double last = 1;
  for (const Index wanted : {60, 400}) {
    const SimplificationError found =
        measure_simplification(F, F.mesh->emission, B, wanted, {.tolerance = 1e-3}, monitor);
    EXPECT_LT(found.indirect.mean, 0.7 * last) << wanted;
    EXPECT_GT(found.indirect.mean, found.averaged.mean) << "shape cannot make good what averaging lost";
    EXPECT_GT(found.averaged.mean, 0);
    last = found.indirect.mean;
  }
  EXPECT_LT(last, 0.2);
}

TEST(SimplificationError, IsThatOfTheMeshAloneInACube) {
  // The same quads as the mesh itself: nothing is simplified and nothing is lost.
  SilentMonitor monitor;
  const FormFactors F = factors_of("cube", 150);
  const Field B = *reference_solution(F, F.mesh->emission);
  EXPECT_LT(measure_simplification(F, F.mesh->emission, B, 150, {.tolerance = 1e-3}, monitor).indirect.max,
            1e-9);
  EXPECT_GT(measure_simplification(F, F.mesh->emission, B, 6, {.tolerance = 1e-3}, monitor).indirect.mean,
            1e-3);
}

TEST(SimplificationError, IsLargeWhereReflectanceWasForgotten) {
  SilentMonitor monitor;
  const FormFactors F = factors_of("cornell-box-closed", 120);
  const Field B = *reference_solution(F, F.mesh->emission);
  PatchMesh broken = *F.mesh;
  broken.reflectance.setConstant(0.5);
  const SimplifiedScene simplified = simplify_to_voxels(*F.mesh, 300);
  const Field H = irradiance_of_lights(compute_form_factors(simplified.mesh, {.tolerance = 1e-3}, monitor),
                                       simplified.mesh->emission);
  const auto error = [&](const PatchMesh& original) {
    return relative_errors(*F.mesh, radiosity_of_patches(simplified, original, H) - F.mesh->emission,
                           B - F.mesh->emission)
        .front();
  };
  EXPECT_GT(error(broken), 2 * error(*F.mesh));
}

TEST(SimplificationError, OfSeveralLightsHasTheirMeanAndMaximum) {
  SilentMonitor monitor;
  const FormFactors F = factors_of("cornell-box-closed", 120);
  const Index c = F.mesh->channels();
  Field emission = Field::Zero(F.patch_count(), 2 * c);
  emission.leftCols(c) = F.mesh->emission;
  emission.row(3).tail(c).setOnes();
  const Field B = *reference_solution(F, emission);
  const auto of = [&](const Field& E, const Field& radiosity) {
    return measure_simplification(F, E, radiosity, 100, {.tolerance = 1e-3}, monitor).indirect;
  };
  const IndirectErrors both = of(emission, B);
  const double first = of(emission.leftCols(c), B.leftCols(c)).max;
  const double second = of(emission.rightCols(c), B.rightCols(c)).max;
  EXPECT_NEAR(both.mean, (first + second) / 2, 1e-9);
  EXPECT_NEAR(both.max, std::max(first, second), 1e-9);
}

TEST(SimplificationError, NeedsLight) {
  SilentMonitor monitor;
  const FormFactors F = factors_of("cube", 6);
  const Field E = F.mesh->emission;
  EXPECT_THROW(measure_simplification(F, E, E, 6, {}, monitor), Error);
}

}  // namespace
}  // namespace radiosity
