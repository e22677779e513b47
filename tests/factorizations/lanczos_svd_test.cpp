// Hard cases F1 and F2 for Lanczos with restarts.

#include "factorizations/lanczos_svd.hpp"
#include "foundation/error.hpp"
#include "hard_matrices.hpp"
#include "test_ratios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace radiosity::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(LanczosSvd, MeetsLapacksTestRatios) {
  for (const HardMatrix& hard : hard_matrices(5)) {
    const SingularValues svd = lanczos_svd(MatrixProducts::of(hard.matrix), {.rank = 12});
    ASSERT_EQ(svd.values.size(), 12) << hard.name;
    EXPECT_LE(triplet_residual(hard.matrix, svd), 50) << hard.name;
    EXPECT_LE(orthogonality(svd.U), 50) << hard.name;
    EXPECT_LE(orthogonality(svd.V), 50) << hard.name;
    const VectorXd truth = singular_value_decomposition(hard.matrix).values.head(12);
    EXPECT_LE((svd.values - truth).cwiseAbs().maxCoeff(), 1000 * double_roundoff * truth[0]) << hard.name;
  }
}

/// Values from 1 down to 1e-10 (F2).
VectorXd ten_decades() {
  return (-10 * std::log(10.0) * VectorXd::LinSpaced(40, 0, 1)).array().exp();
}

double worst_relative_error(const VectorXd& values, const VectorXd& truth) {
  return ((values - truth).array() / truth.array()).abs().maxCoeff();
}

TEST(LanczosSvd, SmallOnesAreRight) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MatrixXd A = matrix_with_values(80, 60, ten_decades(), seed);
    const SingularValues svd = lanczos_svd(MatrixProducts::of(A), {.rank = 40, .seed = seed});
    EXPECT_LE(worst_relative_error(svd.values, ten_decades()), 1e-3) << seed;
  }
}

TEST(LanczosSvd, WouldLoseThemInATransposedA) {
  const MatrixXd A = matrix_with_values(80, 60, ten_decades(), 1);
  const auto square = [&](const MatrixXd& X) { return MatrixXd(A.transpose() * (A * X)); };
  const VectorXd values =
      lanczos_eigenpairs({60, 60, square, square}, {.rank = 40}).values.cwiseAbs().cwiseSqrt();
  EXPECT_LE(worst_relative_error(values.head(20), ten_decades().head(20)), 1e-3);
  EXPECT_GT(worst_relative_error(values, ten_decades()), 1e-3);
}

TEST(LanczosSvd, FindsEveryCopyOfAMultipleValue) {
  VectorXd values = VectorXd::LinSpaced(120, 0.8, 0.1);
  values.head(9) << 1, 1, 1, 1, 0.95, 0.9, 0.9, 0.9, 0.9;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MatrixXd A = matrix_with_values(150, 120, values, seed);
    const SingularValues svd = lanczos_svd(MatrixProducts::of(A), {.rank = 8, .seed = seed});
    EXPECT_LE((svd.values - values.head(8)).cwiseAbs().maxCoeff(), 1e-13) << seed;
    EXPECT_LE(orthogonality(svd.V), 50);
  }
}

TEST(LanczosSvd, SaysWhereItDoesNotConverge) {
  const MatrixXd A = matrix_with_values(150, 120, VectorXd::LinSpaced(120, 1, 0.9), 3);
  EXPECT_THROW(lanczos_svd(MatrixProducts::of(A), {.rank = 8, .basis = 10, .restarts = 5}), Error);
  EXPECT_THROW(lanczos_eigenpairs(MatrixProducts::of(A.topRows(120) + A.topRows(120).transpose()),
                                  {.rank = 8, .basis = 10, .restarts = 5}),
               Error);
  MatrixXd infinite = A;
  infinite(3, 4) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(lanczos_svd(MatrixProducts::of(infinite), {.rank = 8}), Error);
}

/// An operator that is not the one whose transpose it is paired with: no answer can be right.
TEST(LanczosSvd, NoticesProductsThatDoNotBelongTogether) {
  const MatrixXd A = matrix_with_values(60, 60, geometric_values(60, 100), 3);
  const MatrixXd other = A + 1e-6 * MatrixXd::Identity(60, 60);
  MatrixProducts products = MatrixProducts::of(A);
  products.apply_transposed = MatrixProducts::of(other).apply_transposed;
  EXPECT_THROW(lanczos_svd(products, {.rank = 8}), Error);
}

TEST(LanczosEigenpairs, AreTheLargestInMagnitudeWithTheirSigns) {
  VectorXd values = VectorXd::LinSpaced(100, -0.5, 0.5);
  values.head(3) << -1, -0.9, -0.9;
  values.tail(3) << 0.6, 0.95, 1;
  const MatrixXd Q = matrix_with_values(100, 100, VectorXd::Ones(100), 4);
  const MatrixXd S = Q * values.asDiagonal() * Q.transpose();
  const MatrixXd symmetric = 0.5 * (S + S.transpose());
  for (const Index rank : {1, 5, 99, 100, 200}) {
    const SymmetricEigenpairs pairs = lanczos_eigenpairs(MatrixProducts::of(symmetric), {.rank = rank});
    const SymmetricEigenpairs truth = largest_in_magnitude(symmetric_eigenpairs(symmetric), rank);
    ASSERT_EQ(pairs.values.size(), truth.values.size());
    EXPECT_LE((pairs.values.cwiseAbs() - truth.values.cwiseAbs()).cwiseAbs().maxCoeff(), 1e-13) << rank;
    EXPECT_LE(orthogonality(pairs.vectors), 50) << rank;
    EXPECT_LE((symmetric * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), 1e-12) << rank;
  }
}

TEST(LanczosSvd, GivesWhatThereIs) {
  const MatrixXd A = matrix_with_values(12, 7, geometric_values(7, 10), 2);
  const MatrixProducts products = MatrixProducts::of(A);
  EXPECT_EQ(lanczos_svd(products, {.rank = 0}).values.size(), 0);
  const SingularValues all = lanczos_svd(products, {.rank = 100});
  ASSERT_EQ(all.values.size(), 7);
  EXPECT_LE(residual(A, all), 50);
  for (const Index n : {1, 2, 3}) {
    const MatrixXd small = A.topLeftCorner(n, n);
    EXPECT_LE(residual(small, lanczos_svd(MatrixProducts::of(small), {.rank = n})), 50) << n;
  }
  EXPECT_THROW(lanczos_svd(products, {.rank = -1}), UsageError);
  EXPECT_EQ(lanczos_svd(products, {.rank = 3, .seed = 4}).U, lanczos_svd(products, {.rank = 3, .seed = 4}).U);
}

}  // namespace
}  // namespace radiosity::testing
