#include "compression/row_distances.hpp"
#include "compression/row_order.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace radiosity {
namespace {

using Eigen::Index;

CodeMatrix random_code_matrix(Index rows, Index cols, std::uint64_t seed) {
  RandomStream random(seed);
  return CodeMatrix::NullaryExpr(rows, cols, [&] { return static_cast<std::uint8_t>(random.below(256)); });
}

/// Squared distances of points that come one after the other on a line, in the given order.
Eigen::MatrixXd on_a_line(const std::vector<double>& points) {
  const auto n = static_cast<Index>(points.size());
  return Eigen::MatrixXd::NullaryExpr(n, n, [&](Index i, Index j) {
    const double difference = points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)];
    return difference * difference;
  });
}

Eigen::MatrixXd in_a_square(Index n, std::uint64_t seed) {
  RandomStream random(seed);
  const Eigen::MatrixXd points = Eigen::MatrixXd::NullaryExpr(2, n, [&] { return random.uniform(); });
  return Eigen::MatrixXd::NullaryExpr(
      n, n, [&](Index i, Index j) { return (points.col(i) - points.col(j)).squaredNorm(); });
}

bool is_order(std::vector<Index> order) {
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != static_cast<Index>(i)) return false;
  return true;
}

TEST(RowDistances, AreTheExactWholeNumbers) {
  for (const Index n : {0, 1, 2, 5, 33}) {
    std::vector<CodeMatrix> channels = {random_code_matrix(n, 2101, 1), random_code_matrix(n, 7, 2),
                                        random_code_matrix(n, 0, 3)};
    if (n > 1) {  // the largest sums there can be: float32 alone would round them
      channels[0].row(0).setZero();
      channels[0].row(1).setConstant(255);
    }
    const Eigen::MatrixXd squared = squared_row_distances(channels);
    ASSERT_EQ(squared.rows(), n);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        std::int64_t sum = 0;
        for (const CodeMatrix& codes : channels)
          for (Index k = 0; k < codes.cols(); ++k) {
            const int difference = int{codes(i, k)} - int{codes(j, k)};
            sum += difference * difference;
          }
        EXPECT_EQ(squared(i, j), static_cast<double>(sum)) << i << " " << j;
      }
  }
}

TEST(RowDistances, RefuseChannelsOfDifferentSizes) {
  const std::vector<CodeMatrix> channels = {random_code_matrix(4, 4, 1), random_code_matrix(5, 4, 1)};
  EXPECT_THROW(squared_row_distances(channels), UsageError);
  EXPECT_EQ(squared_row_distances({}).size(), 0);
}

TEST(RowOrder, GreedyGoesToTheNearestThatIsLeft) {
  EXPECT_EQ(greedy_order(on_a_line({5, 1, 9, 6, 4.5, 8})), (std::vector<Index>{0, 4, 3, 5, 2, 1}));
  EXPECT_EQ(greedy_order(on_a_line({5, 6, 4, 6})), (std::vector<Index>{0, 1, 3, 2})) << "ties: the first";
  EXPECT_EQ(greedy_order(on_a_line({7, 7, 7})), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(greedy_order(on_a_line({1})), (std::vector<Index>{0}));
  EXPECT_TRUE(greedy_order(Eigen::MatrixXd(0, 0)).empty());
}

TEST(RowOrder, LengthIsTheSumOfEuclideanDistances) {
  const Eigen::MatrixXd squared = on_a_line({5, 1, 9});
  EXPECT_DOUBLE_EQ(path_length(squared, {0, 1, 2}), 12);
  EXPECT_DOUBLE_EQ(path_length(squared, {1, 0, 2}), 8);
  EXPECT_EQ(path_length(squared, {}), 0);
}

TEST(RowOrder, TwoOptShortensThePathOfTheGreedyOrder) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Eigen::MatrixXd squared = in_a_square(300, seed);
    const std::vector<Index> greedy = greedy_order(squared);
    const std::vector<Index> shorter = two_opt_order(squared, greedy);
    EXPECT_TRUE(is_order(greedy) && is_order(shorter));
    EXPECT_EQ(shorter.front(), 0);
    EXPECT_LT(path_length(squared, shorter), 0.92 * path_length(squared, greedy));
    EXPECT_EQ(two_opt_order(squared, shorter), shorter) << "nothing is left to turn";
    EXPECT_EQ(two_opt_order(squared, greedy, 0), greedy);
  }
}

TEST(RowOrder, TwoOptFindsTheShortestOfAFewRows) {
  for (const std::uint64_t seed : {4, 5, 6, 7}) {
    const Eigen::MatrixXd squared = in_a_square(7, seed);
    std::vector<Index> order(7);
    std::iota(order.begin(), order.end(), 0);
    const double found = path_length(squared, two_opt_order(squared, order));
    double shortest = path_length(squared, order);
    while (std::next_permutation(order.begin() + 1, order.end()))
      shortest = std::min(shortest, path_length(squared, order));
    EXPECT_GE(found, shortest - 1e-12);
    EXPECT_LE(found, 1.15 * shortest);
  }
}

TEST(RowOrder, WorksAtEverySize) {
  for (const Index n : {0, 1, 2, 3, 5, 17}) {
    const Eigen::MatrixXd squared = in_a_square(n, 9);
    EXPECT_TRUE(is_order(two_opt_order(squared, greedy_order(squared))));
    EXPECT_EQ(greedy_order(squared).size(), static_cast<std::size_t>(n));
  }
}

TEST(RowOrder, DoesNotDependOnThreads) {
  const std::vector<CodeMatrix> channels = {random_code_matrix(150, 200, 1), random_code_matrix(150, 200, 2)};
  const Eigen::MatrixXd squared = squared_row_distances(channels);
  const std::vector<Index> order = two_opt_order(squared, greedy_order(squared));
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    const Eigen::MatrixXd again = squared_row_distances(channels);
    EXPECT_EQ(again, squared);
    EXPECT_EQ(two_opt_order(again, greedy_order(again)), order);
  }
}

TEST(RowOrder, RefusesWhatIsNoOrder) {
  const Eigen::MatrixXd squared = on_a_line({1, 2, 3});
  EXPECT_THROW(two_opt_order(squared, {0, 1}), UsageError);
  EXPECT_THROW(two_opt_order(squared, {0, 1, 1}), UsageError);
  EXPECT_THROW(two_opt_order(squared, {0, 1, 3}), UsageError);
  EXPECT_THROW(two_opt_order(squared, {0, 1, -1}), UsageError);
}

}  // namespace
}  // namespace radiosity
