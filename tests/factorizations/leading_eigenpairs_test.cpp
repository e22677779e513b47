#include "factorizations/lapack.hpp"
#include "factorizations/leading_eigenpairs.hpp"
#include "factorizations/spectral_clusters.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

/// Q diag(values) Q' for a random orthogonal Q.
Eigen::MatrixXd matrix_with(const Eigen::VectorXd& values, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::MatrixXd numbers(values.size(), values.size());
  for (Eigen::Index i = 0; i < numbers.size(); ++i) numbers(i) = random.uniform(-1, 1);
  const Eigen::MatrixXd Q = orthonormal_columns(numbers);
  const Eigen::MatrixXd product = Q * values.asDiagonal() * Q.transpose();
  return 0.5 * (product + product.transpose());
}

LeadingEigenpairs pairs_of(const Eigen::MatrixXd& S, EigenpairOptions options = {}) {
  return leading_eigenpairs([&](const Eigen::MatrixXd& X) { return Eigen::MatrixXd(S * X); }, S.rows(),
                            options);
}

/// Values from -0.3 to 0.5 below `leading`.
Eigen::VectorXd spectrum(const std::vector<double>& leading, Eigen::Index n) {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(n, -0.3, 0.5);
  for (std::size_t k = 0; k < leading.size(); ++k) values[n - 1 - static_cast<Eigen::Index>(k)] = leading[k];
  return values;
}

TEST(LeadingEigenpairs, FindsEveryCopyOfAMultipleValue) {
  const std::vector<double> leading = {0.9999, 0.99, 0.99, 0.99, 0.99, 0.99, 0.99, 0.8};
  const Eigen::MatrixXd S = matrix_with(spectrum(leading, 200), 3);
  EigenpairOptions options;
  options.accuracy = 1e-6;
  const LeadingEigenpairs pairs = pairs_of(S, options);
  ASSERT_EQ(pairs.values.size(), 8);
  for (Eigen::Index k = 0; k < 8; ++k)
    EXPECT_NEAR(pairs.values[k], leading[static_cast<std::size_t>(k)], 1e-8);
  EXPECT_NEAR((pairs.vectors.transpose() * pairs.vectors - Eigen::MatrixXd::Identity(8, 8)).norm(), 0, 1e-12);
  EXPECT_NEAR((S * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), pairs.residual, 1e-10);
}

TEST(LeadingEigenpairs, TheRestIsBoundedOverManySeeds) {
  const Eigen::MatrixXd S = matrix_with(spectrum({0.97, 0.95}, 150), 4);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    EigenpairOptions options;
    options.seed = seed;
    const LeadingEigenpairs pairs = pairs_of(S, options);
    ASSERT_EQ(pairs.values.size(), 2);
    const Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(150, 150) - pairs.vectors * pairs.vectors.transpose();
    const double rest = symmetric_eigenpairs(Q * S * Q).values.maxCoeff();
    EXPECT_LE(rest, pairs.rest_bound);
    EXPECT_LE(pairs.rest_bound, rest + 0.1);
  }
}

TEST(LeadingEigenpairs, ForgettingOneVectorBreaksTheBound) {
  const Eigen::MatrixXd S = matrix_with(spectrum({0.97, 0.95}, 150), 4);
  LeadingEigenpairs pairs = pairs_of(S);
  pairs.vectors.conservativeResize(Eigen::NoChange, 1);
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(150, 150) - pairs.vectors * pairs.vectors.transpose();
  const double rest = symmetric_eigenpairs(Q * S * Q).values.maxCoeff();
  EXPECT_GT(rest, pairs.rest_bound);
}

TEST(EigenvalueInterval, HoldsEveryEigenvalueOverManySeeds) {
  const Eigen::MatrixXd S = matrix_with(spectrum({0.97, 0.95}, 150), 4);
  const Eigen::MatrixXd negative = -2 * S;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto interval = [&](const Eigen::MatrixXd& matrix) {
      return eigenvalue_interval([&](const Eigen::MatrixXd& X) { return Eigen::MatrixXd(matrix * X); }, 150,
                                 0.9999, seed);
    };
    EXPECT_GE(interval(S).high, 0.97);
    EXPECT_LE(interval(S).low, -0.3);
    EXPECT_LE(interval(S).high, 1.02);
    EXPECT_LE(interval(S).largest_ritz, 0.97 + 1e-12);
    EXPECT_LE(interval(negative).low, -1.94);
    EXPECT_GE(interval(negative).low, -2.1);
  }
}

TEST(LeadingEigenpairs, SmallAndExtremeMatrices) {
  EXPECT_EQ(pairs_of(Eigen::MatrixXd(0, 0)).values.size(), 0);
  for (const Eigen::Index n : {1, 2, 3, 5, 17}) {
    const LeadingEigenpairs zero = pairs_of(Eigen::MatrixXd::Zero(n, n));
    EXPECT_EQ(zero.values.size(), 0);
    EXPECT_NEAR(zero.rest_bound, 0, 1e-12);
    const LeadingEigenpairs all = pairs_of(0.99 * Eigen::MatrixXd::Identity(n, n), {.wanted_value = 0.5});
    EXPECT_EQ(all.values.size(), n);
  }
}

TEST(LeadingEigenpairs, StopsAtTheMostThatAreAllowed) {
  const Eigen::MatrixXd S = matrix_with(spectrum({0.99, 0.98, 0.97, 0.96}, 120), 5);
  EigenpairOptions options;
  options.most = 2;
  const LeadingEigenpairs pairs = pairs_of(S, options);
  EXPECT_EQ(pairs.values.size(), 2);
  EXPECT_GE(pairs.rest_bound, 0.9699);
}

TEST(SpectralClusters, WeaklyCoupledBlocksAreToldApart) {
  const Eigen::Index blocks = 4, size = 15;
  Eigen::MatrixXd S =
      Eigen::MatrixXd::Constant(blocks * size, blocks * size, 1e-3 / static_cast<double>(size));
  for (Eigen::Index b = 0; b < blocks; ++b)
    S.block(b * size, b * size, size, size).setConstant(0.95 / static_cast<double>(size));
  const std::vector<int> clusters = spectral_clusters(pairs_of(S, {.wanted_value = 0.8}).vectors);
  for (Eigen::Index i = 0; i < blocks * size; ++i)
    EXPECT_EQ(clusters[static_cast<std::size_t>(i)], i / size) << i;
}

}  // namespace
}  // namespace radiosity
