#include "factorizations/cosines.hpp"
#include "factorizations/haar_wavelets.hpp"
#include "factorizations/halving_order.hpp"
#include "foundation/random.hpp"
#include "hard_matrices.hpp"
#include "test_ratios.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace radiosity::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Index> numbers(Index count, Index first = 0) {
  std::vector<Index> list(static_cast<std::size_t>(count));
  std::iota(list.begin(), list.end(), first);
  return list;
}

VectorXd random_weights(Index n) {
  RandomStream random(3);
  VectorXd weights(n);
  for (double& weight : weights) weight = std::pow(10, random.uniform(-3, 3));
  return weights;
}

/// W of a family, for which coefficients() must be W' X.
MatrixXd functions_of(const FunctionFamily& family) {
  MatrixXd W = family.columns(numbers(family.count));
  const MatrixXd X = matrix_with_values(family.items, 3, VectorXd::Ones(std::min<Index>(3, family.items)), 5);
  EXPECT_LE((family.coefficients(X) - W.transpose() * X).norm(), 1e-13);
  return W;
}

/// A grid of so many places, numbered row by row.
PlacedSet grid(Index across, Index up) {
  PlacedSet set;
  set.items = numbers(across * up);
  set.places.resize(2, across * up);
  for (Index row = 0; row < up; ++row)
    for (Index column = 0; column < across; ++column)
      set.places.col(row * across + column)
          << (static_cast<double>(column) + 0.5) / static_cast<double>(across),
          (static_cast<double>(row) + 0.5) / static_cast<double>(up);
  return set;
}

TEST(HaarWavelets, AreOrthonormalForAnySetsAndWeights) {
  for (const Index n : {1, 2, 3, 7, 8, 33}) {
    std::vector<std::vector<Index>> sets = {numbers(n - n / 3), numbers(n / 3, n - n / 3)};
    std::reverse(sets[0].begin(), sets[0].end());
    const FunctionFamily family = haar_wavelets(sets, random_weights(n));
    ASSERT_EQ(family.count, n);
    EXPECT_LE(orthogonality(functions_of(family)), 50) << n;
  }
}

TEST(HaarWavelets, AreTheTextbooksOnFourItems) {
  const MatrixXd W = functions_of(haar_wavelets({numbers(4)}, VectorXd::Ones(4)));
  MatrixXd expected(4, 4);
  const double root = std::sqrt(0.5);
  expected << 0.5, 0.5, root, 0, 0.5, 0.5, -root, 0, 0.5, -0.5, 0, root, 0.5, -0.5, 0, -root;
  EXPECT_LE((W - expected).norm(), 1e-15);
}

TEST(Cosines, AreTheTransformOnGridsAndLines) {
  const Index across = 6, up = 4;
  const MatrixXd W = functions_of(cosines({grid(across, up)}, VectorXd::Ones(across * up)));
  EXPECT_LE(orthogonality(W), 50);
  // The first is constant; the others have mean 0 and are products of cosines.
  EXPECT_LE((W.col(0).array() - 1 / std::sqrt(24.0)).matrix().norm(), 1e-14);
  EXPECT_LE(W.rightCols(23).colwise().sum().cwiseAbs().maxCoeff(), 1e-13);
  PlacedSet line = grid(9, 1);
  line.aspect = std::numeric_limits<double>::infinity();
  const MatrixXd D = functions_of(cosines({line}, VectorXd::Ones(9)));
  for (Index k = 0; k < 9; ++k)
    for (Index i = 0; i < 9; ++i) {
      const double value =
          std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(i) + 0.5) / 9);
      EXPECT_NEAR(D(i, k), value * std::sqrt((k == 0 ? 1 : 2) / 9.0), 1e-14);
    }
}

TEST(Cosines, HaveLengthOneAnywhere) {
  RandomStream random(8);
  PlacedSet set{numbers(23), Eigen::Matrix2Xd(2, 23), 0.3};
  for (Index k = 0; k < set.places.size(); ++k) set.places(k) = random.uniform();
  const MatrixXd W = functions_of(cosines({set}, random_weights(23)));
  ASSERT_EQ(W.cols(), 23);
  EXPECT_LE((W.colwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  EXPECT_EQ(singular_value_decomposition(W.leftCols(5)).values.minCoeff() > 1e-6, true);
}

TEST(ProjectionOnFunctions, FindsThoseThatCarryTheMatrix) {
  const Index n = 64;
  const FunctionFamily family = haar_wavelets({numbers(n)}, VectorXd::Ones(n));
  const std::vector<Index> which = {3, 17, 42, 60};
  const MatrixXd A =
      matrix_with_values(80, 4, geometric_values(4, 10), 7) * family.columns(which).transpose();
  const LowRankPair pair = project_on_functions(MatrixProducts::of(A), family, 4, 1);
  ASSERT_EQ(pair.V.cols(), 4);
  EXPECT_LE((A - pair.U * pair.V.transpose()).norm(), 1e-13);
  // More than there are: the rest carries nothing.
  EXPECT_EQ(project_on_functions(MatrixProducts::of(A), family, 30, 1).V.cols(), 4);
  // The wrong ones would not do.
  const MatrixXd first = family.columns(numbers(4));
  EXPECT_GT((A - A * first * first.transpose()).norm(), 0.1);
}

TEST(ProjectionOnFunctions, LosesLittleByTheSketch) {
  const Index n = 400;
  const FunctionFamily family = cosines({grid(20, 20)}, VectorXd::Ones(n));
  const MatrixXd A = matrix_with_values(n, n, geometric_values(n, 1e3), 9);
  const MatrixXd coefficients = A * family.columns(numbers(n));
  VectorXd squares = coefficients.colwise().squaredNorm();
  std::sort(squares.begin(), squares.end());
  const Index rank = 40;
  const double best = std::sqrt(squares.head(n - rank).sum());
  const LowRankPair pair = project_on_functions(MatrixProducts::of(A), family, rank, 1);
  EXPECT_LE((A - pair.U * pair.V.transpose()).norm(), 1.02 * best);
}

TEST(HalvingOrder, KeepsHalvesCompact) {
  const PlacedSet set = grid(4, 4);
  const std::vector<Index> order = halving_order(set.places);
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, numbers(16));
  // Quarters of the square are quarters of the sequence.
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    Eigen::Vector2d low = set.places.col(order[4 * quarter]), high = low;
    for (std::size_t k = 4 * quarter; k < 4 * quarter + 4; ++k) {
      low = low.cwiseMin(Eigen::Vector2d(set.places.col(order[k])));
      high = high.cwiseMax(Eigen::Vector2d(set.places.col(order[k])));
    }
    EXPECT_NEAR((high - low).maxCoeff(), 0.25, 1e-15);
  }
  EXPECT_TRUE(halving_order(MatrixXd(2, 0)).empty());
}

}  // namespace
}  // namespace radiosity::testing
