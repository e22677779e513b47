#include "foundation/error.hpp"
#include "render/reference_comparison.hpp"
#include "rooms.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

using namespace test;

/// A furnace and what a tracer without noise would say of it.
struct ExactFurnace {
  PatchMesh mesh = make_patches(box_room({1, 1, 1}), {.patches = 24});
  PathTracedIrradiance reference;
  Eigen::MatrixXd B;

  ExactFurnace() {
    make_furnace(mesh, 0.5, 1);
    reference.irradiance = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, 2);
    reference.standard_error = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, 0.01);
    B = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, 2);
  }
};

TEST(ReferenceComparison, EqualSolutionsDoNotDiffer) {
  const ExactFurnace furnace;
  const ReferenceComparison result = compare_with_reference(furnace.mesh, furnace.B, furnace.reference);
  EXPECT_NEAR(result.mean_difference, 0, 1e-15);
  EXPECT_EQ(result.rms_difference, 0);
  EXPECT_EQ(result.beyond_four_standard_errors, 0);
  // 24 patches of equal area: rho * 0.01 / sqrt(24), relative to rho H = 1.
  EXPECT_NEAR(result.mean_difference_standard_error, 0.005 / std::sqrt(24), 1e-12);
  EXPECT_NEAR(result.rms_standard_error, 0.005, 1e-12);
}

TEST(ReferenceComparison, DifferencesAreRelativeToReflectedLight) {
  ExactFurnace furnace;
  furnace.B.array() += 0.03;  // 3 % of rho H = 1, although B is 2
  const ReferenceComparison result = compare_with_reference(furnace.mesh, furnace.B, furnace.reference);
  EXPECT_NEAR(result.mean_difference, 0.03, 1e-12);
  EXPECT_NEAR(result.rms_difference, std::sqrt(0.03 * 0.03 - 0.005 * 0.005), 1e-12);
  EXPECT_EQ(result.beyond_four_standard_errors, 1);
  // d = 0.03 and s = 0.005 on 24 patches: the variance of a square is 4 d^2 s^2 + 2 s^4 (d^2 less s^2, as it
  // is seen).
  const double square = 0.03 * 0.03 - 0.005 * 0.005;
  const double error = std::sqrt((4 * square * std::pow(0.005, 2) + 2 * std::pow(0.005, 4)) / 24);
  EXPECT_NEAR(result.rms_difference_standard_error, std::sqrt(square + error) - std::sqrt(square), 1e-12);
}

TEST(ReferenceComparison, GroupsTellWhereTheDifferenceIs) {
  ExactFurnace furnace;
  for (Index i = 0; i < furnace.mesh.patch_count(); ++i)
    if (furnace.mesh.patches[static_cast<std::size_t>(i)].group == 2) furnace.B(i, 0) += 0.1;
  const ReferenceComparison result = compare_with_reference(furnace.mesh, furnace.B, furnace.reference);
  ASSERT_EQ(result.groups.size(), 6U);
  for (std::size_t g = 0; g < 6; ++g) {
    EXPECT_EQ(result.groups[g].group, furnace.mesh.scene->groups[g]);
    EXPECT_NEAR(result.groups[g].area, 1, 1e-12);
    EXPECT_NEAR(result.groups[g].reference, 1, 1e-12);
    EXPECT_NEAR(result.groups[g].difference, g == 2 ? 0.1 : 0, 1e-12);
    EXPECT_NEAR(result.groups[g].standard_error, 0.005 / 2, 1e-12);  // 4 patches a wall
  }
  EXPECT_NEAR(result.mean_difference, 0.1 / 6, 1e-12);
}

TEST(ReferenceComparison, NoiseIsTakenOutOfTheDifference) {
  // A true furnace against its exact solution: what is left is less than the noise, by far.
  ExactFurnace furnace;
  SilentMonitor monitor;
  const PathTracedIrradiance traced = trace_paths(furnace.mesh, {.paths = 1024}, monitor);
  const ReferenceComparison result = compare_with_reference(furnace.mesh, furnace.B, traced);
  EXPECT_LT(std::abs(result.mean_difference), 4 * result.mean_difference_standard_error);
  EXPECT_LT(result.rms_difference, result.rms_standard_error);
  EXPECT_EQ(result.beyond_four_standard_errors, 0);
  // Broken: B that forgets the reflectance of one bounce.
  const Eigen::MatrixXd broken = furnace.B * 0.9;
  const ReferenceComparison off = compare_with_reference(furnace.mesh, broken, traced);
  EXPECT_GT(std::abs(off.mean_difference), 4 * off.mean_difference_standard_error);
}

TEST(ReferenceComparison, RefusesWhatCannotBeCompared) {
  ExactFurnace furnace;
  EXPECT_THROW(compare_with_reference(furnace.mesh, Eigen::MatrixXd::Zero(3, 1), furnace.reference),
               UsageError);
  furnace.reference.irradiance.setZero();
  EXPECT_THROW(compare_with_reference(furnace.mesh, furnace.B, furnace.reference), Error);
}

}  // namespace
}  // namespace radiosity
