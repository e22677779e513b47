// Hard cases F1 and F2: LAPACK's test ratios (at most 50) for singular value decompositions and QR.

#include "factorizations/randomized_svd.hpp"
#include "foundation/error.hpp"
#include "hard_matrices.hpp"
#include "test_ratios.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(SingularValues, MeetLapacksTestRatios) {
  for (const HardMatrix& hard : hard_matrices(5)) {
    const SingularValues svd = singular_value_decomposition(hard.matrix);
    EXPECT_LE(residual(hard.matrix, svd), 50) << hard.name;
    EXPECT_LE(orthogonality(svd.U), 50) << hard.name;
    EXPECT_LE(orthogonality(svd.V), 50) << hard.name;
    for (Index k = 1; k < svd.values.size(); ++k) EXPECT_GE(svd.values[k - 1], svd.values[k]) << hard.name;
    if (hard.values.size() == 0) continue;
    const double allowed = 100 * double_roundoff * hard.values[0];
    EXPECT_LE((svd.values.head(hard.values.size()) - hard.values).cwiseAbs().maxCoeff(), allowed)
        << hard.name;
  }
}

// F2: to 1e-3 down to 1e-10 of the largest.
TEST(SingularValues, SmallOnesAreRight) {
  const VectorXd values = (-10 * std::log(10.0) * VectorXd::LinSpaced(40, 0, 1)).array().exp();
  const SingularValues svd = singular_value_decomposition(matrix_with_values(80, 60, values, 3));
  for (Index k = 0; k < 40; ++k) EXPECT_NEAR(svd.values[k], values[k], 1e-3 * values[k]) << k;
}

TEST(PivotedQr, MeetsLapacksTestRatiosAndRevealsRank) {
  for (const HardMatrix& hard : hard_matrices(6)) {
    const PivotedQr qr = pivoted_qr(hard.matrix);
    EXPECT_LE(orthogonality(qr.Q), 50) << hard.name;
    const double scale = std::max(hard.matrix.cwiseAbs().maxCoeff(), 1e-300);
    // A P = Q (Q' A P) holds where Q spans the range.
    const MatrixXd A = hard.matrix / scale;
    EXPECT_LE((A - qr.Q * (qr.Q.transpose() * A)).norm(), 50 * 70 * double_roundoff * A.norm()) << hard.name;
    for (Index k = 1; k < qr.diagonal.size(); ++k)
      EXPECT_GE(qr.diagonal[k - 1] * (1 + 1e-12), qr.diagonal[k]) << hard.name;
    if (hard.name == "rank deficient") {
      EXPECT_EQ(orthonormal_columns(hard.matrix).cols(), 15);
    }
  }
}

/// Error over the optimum, which the singular values beyond the rank give.
double over_optimum(const HardMatrix& hard, const SingularValues& svd) {
  const double scale = hard.values[0];
  const MatrixXd difference =
      hard.matrix / scale - svd.U * (svd.values / scale).asDiagonal() * svd.V.transpose();
  const double optimum = (hard.values.tail(hard.values.size() - svd.values.size()) / scale).norm();
  return difference.norm() / std::max(optimum, 1e-13);
}

TEST(RandomizedSvd, IsWithinAQuarterOfTheOptimumForTwentySeeds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const HardMatrix& hard : hard_matrices(seed)) {
      if (hard.values.size() == 0 || hard.values[0] == 0) continue;
      const SingularValues svd = randomized_svd(MatrixProducts::of(hard.matrix), {.rank = 12, .seed = seed});
      EXPECT_LE(over_optimum(hard, svd), 1.25) << hard.name << ", seed " << seed;
      EXPECT_LE(orthogonality(svd.U), 50) << hard.name;
      EXPECT_LE(orthogonality(svd.V), 50) << hard.name;
    }
}

TEST(RandomizedSvd, ABareSketchIsNoticed) {
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const HardMatrix hard = hard_matrices(seed).front();  // values from 1 to 1/2
    const HardMatrix steep = {"steep", matrix_with_values(60, 60, geometric_values(60, 1e8), seed),
                              geometric_values(60, 1e8)};
    for (const HardMatrix* one : {&hard, &steep})
      worst = std::max(
          worst, over_optimum(
                     *one, randomized_svd(MatrixProducts::of(one->matrix),
                                          {.rank = 12, .oversampling = 0, .power_steps = 0, .seed = seed})));
  }
  EXPECT_GT(worst, 1.25);
}

TEST(RandomizedSvd, GivesWhatThereIs) {
  const HardMatrix hard = hard_matrices(9)[0];
  const MatrixProducts products = MatrixProducts::of(hard.matrix);
  EXPECT_EQ(randomized_svd(products, {.rank = 0}).values.size(), 0);
  const SingularValues all = randomized_svd(products, {.rank = 1000});
  ASSERT_EQ(all.values.size(), 60);
  EXPECT_LE(residual(hard.matrix, all), 50);
  const MatrixXd zero = MatrixXd::Zero(8, 5);
  EXPECT_EQ(randomized_svd(MatrixProducts::of(zero), {.rank = 3}).values.norm(), 0);
  EXPECT_THROW(randomized_svd(products, {.rank = -1}), UsageError);
  const SingularValues once = randomized_svd(products, {.rank = 7, .seed = 4});
  EXPECT_EQ(once.U, randomized_svd(products, {.rank = 7, .seed = 4}).U);
  EXPECT_NE(once.U, randomized_svd(products, {.rank = 7, .seed = 5}).U);
}

TEST(LuFactors, KnowTheSignOfTheDeterminant) {
  for (const Index n : {1, 2, 3, 8, 33})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Eigen::MatrixXd matrix = matrix_with_values(n, n, geometric_values(n, 1e3), seed);
      const bool positive = matrix.determinant() > 0;
      EXPECT_EQ(LuFactors(matrix).has_positive_determinant(), positive) << n;
      matrix.row(0) *= -1;
      EXPECT_EQ(LuFactors(matrix).has_positive_determinant(), !positive) << n;
    }
  EXPECT_TRUE(LuFactors(Eigen::MatrixXd(0, 0)).has_positive_determinant());
  EXPECT_FALSE(LuFactors(Eigen::MatrixXd::Zero(3, 3)).has_positive_determinant());
}

}  // namespace
}  // namespace radiosity::testing
