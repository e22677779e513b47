#include "factorizations/symmetric_scaling.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

Eigen::MatrixXd positive_matrix(Eigen::Index n, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      matrix(i, j) = matrix(j, i) = random.uniform(0.5, 1.5) / static_cast<double>(n);
  return matrix;
}

SymmetricScaling scale(const Eigen::MatrixXd& K, const Eigen::VectorXd& weights,
                       const Eigen::VectorXd& target) {
  return scale_symmetric([&](const Eigen::VectorXd& x) { return Eigen::VectorXd(K * x); }, weights, target);
}

/// Largest deviation of the scaled row sums from their targets.
double row_deviation(const Eigen::MatrixXd& K, const Eigen::VectorXd& d, const Eigen::VectorXd& weights,
                     const Eigen::VectorXd& target) {
  const Eigen::VectorXd sums = (d.asDiagonal() * K * d.cwiseProduct(weights)).cwiseQuotient(weights);
  return (sums - target).cwiseAbs().maxCoeff();
}

TEST(SymmetricScaling, ReachesTheWantedRowSums) {
  const Eigen::MatrixXd K = positive_matrix(40, 1);
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(40, 0.8, 1.2);
  const Eigen::VectorXd target = Eigen::VectorXd::LinSpaced(40, 1.2, 0.8);
  const SymmetricScaling scaling = scale(K, weights, target);
  EXPECT_TRUE(scaling.exists) << scaling.note;
  EXPECT_LT(row_deviation(K, scaling.factors, weights, target), 1e-12);
  EXPECT_GT(row_deviation(K, Eigen::VectorXd::Ones(40), weights, target), 1e-2);  // the check can fail
}

TEST(SymmetricScaling, OnlyRemovesEnergyWhereItDoesNotExist) {
  // Two plates that see each other and nothing else, one of them larger: rows cannot both sum to 1.
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2, 2);
  K(0, 1) = K(1, 0) = 0.7;
  const Eigen::Vector2d weights(1, 2), target(1, 1);
  const SymmetricScaling scaling = scale(K, weights, target);
  EXPECT_FALSE(scaling.exists);
  EXPECT_NE(scaling.note.find("no symmetric scaling"), std::string::npos);
  EXPECT_LE(scaling.factors.maxCoeff(), 1);
  const Eigen::VectorXd sums =
      (scaling.factors.asDiagonal() * K * scaling.factors.cwiseProduct(weights)).cwiseQuotient(weights);
  EXPECT_LE(sums.maxCoeff(), 1);
}

TEST(SymmetricScaling, LeavesEmptyRowsAlone) {
  Eigen::MatrixXd K = positive_matrix(5, 2);
  K.row(3).setZero();
  K.col(3).setZero();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(5);
  EXPECT_FALSE(scale(K, ones, ones).exists);
  Eigen::VectorXd target = ones;
  target[3] = 0;
  const SymmetricScaling scaling = scale(K, ones, target);
  EXPECT_TRUE(scaling.exists) << scaling.note;
  EXPECT_EQ(scaling.factors[3], 1);
}

}  // namespace
}  // namespace radiosity
