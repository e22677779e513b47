#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/segment_products.hpp"
#include "kernels/segment_sums.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace radiosity {
namespace {

/// n rows that fall into `count` segments at random; some segments are empty, one is long.
Segments random_segments(Index n, Index count, bool weighted, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<std::int32_t> segment(static_cast<std::size_t>(n));
  for (std::int32_t& p : segment)
    p = random.uniform() < 0.3 ? static_cast<std::int32_t>(count / 2)
                               : static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(count)));
  std::vector<double> weights(weighted ? static_cast<std::size_t>(n) : 0);
  for (double& weight : weights) weight = random.uniform(-2, 2);
  return sort_by_segment(segment, count, weights);
}

/// The same matrix in full; rows as in the scene or sorted.
Eigen::MatrixXd full_matrix(const Segments& V, RowOrder rows) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(V.rows(), V.count());
  for (Index p = 0; p < V.count(); ++p)
    for (auto s = static_cast<std::size_t>(V.offsets()[static_cast<std::size_t>(p)]);
         s < static_cast<std::size_t>(V.offsets()[static_cast<std::size_t>(p) + 1]); ++s)
      full(rows == RowOrder::scene && !V.order().empty() ? V.order()[s] : static_cast<Index>(s), p) =
          V.weights().empty() ? 1 : V.weights()[s];
  return full;
}

/// |C - V' X| <= 40 u |V'| |X|, with the sums in long double.
testing::AssertionResult within_sums_bound(const Segments& V, RowOrder rows, const Eigen::MatrixXd& X,
                                           const Eigen::MatrixXd& C) {
  for (Index c = 0; c < X.cols(); ++c)
    for (Index p = 0; p < V.count(); ++p) {
      long double exact = 0;
      long double magnitude = 0;
      for (auto s = static_cast<std::size_t>(V.offsets()[static_cast<std::size_t>(p)]);
           s < static_cast<std::size_t>(V.offsets()[static_cast<std::size_t>(p) + 1]); ++s) {
        const Index row =
            rows == RowOrder::scene && !V.order().empty() ? V.order()[s] : static_cast<Index>(s);
        const long double term = (V.weights().empty() ? 1.0L : V.weights()[s]) * X(row, c);
        exact += term;
        magnitude += std::fabs(term);
      }
      if (!(std::fabs(C(p, c) - exact) <= 40 * 0x1p-53L * magnitude))
        return testing::AssertionFailure() << "sum (" << p << ", " << c << ") is " << C(p, c)
                                           << ", should be " << static_cast<double>(exact);
    }
  return testing::AssertionSuccess();
}

void expect_right_sums(Index n, Index count, Index columns) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const bool weighted : {false, true})
    for (const RowOrder rows : {RowOrder::scene, RowOrder::sorted}) {
      SCOPED_TRACE(std::to_string(n) + " rows, " + std::to_string(count) + " segments, " +
                   std::to_string(columns) + " columns");
      const Segments V = random_segments(n, count, weighted, 51);
      const Eigen::MatrixXd X = random_matrix(n, columns, 52);
      Eigen::MatrixXd C = Eigen::MatrixXd::Constant(count, columns, nan);
      segment_sums(V, X, C, rows);
      EXPECT_TRUE(within_sums_bound(V, rows, X, C));
      Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(n, columns, nan);
      spread_segments(V, C, Y, rows);
      const Eigen::MatrixXd expected = full_matrix(V, rows) * C;
      EXPECT_EQ(Y, expected);
    }
}

TEST(SegmentSums, MeetTheirBoundForEverySize) {
  for (const Index n : {0, 1, 63, 64, 65, 300, 8192, 20000})
    for (const Index count : {1, 24, 64}) expect_right_sums(n, count, 1);
  for (const Index columns : {0, 3, 4, 7}) expect_right_sums(9000, 31, columns);
}

TEST(SegmentSums, MeetTheirBoundWhereverSegmentsEnd) {
  // Ends on, before and behind the places where chunks are cut; empty segments at all of them; one segment
  // over several chunks.
  const std::vector<std::int64_t> offsets = {0,     0,     1,     8191,  8192,  8192,  8193,  16384, 16384,
                                             16384, 49152, 49152, 49153, 65535, 65536, 65536, 65536};
  const Segments V(offsets);
  const Eigen::MatrixXd X = random_matrix(V.rows(), 2, 53);
  Eigen::MatrixXd C = Eigen::MatrixXd::Constant(V.count(), 2, std::numeric_limits<double>::quiet_NaN());
  segment_sums(V, X, C);
  EXPECT_TRUE(within_sums_bound(V, RowOrder::sorted, X, C));
  for (const Index empty : {0, 4, 7, 8, 10, 14, 15}) EXPECT_EQ(C(empty, 1), 0) << empty;
}

TEST(SegmentSums, BoundFailsForSumsWithoutCompensation) {
  // Equal numbers whose plain sum loses a little each time, but not in long double: they have 40 bits.
  const Segments V({0, 3000000});
  const Eigen::VectorXd X =
      Eigen::VectorXd::Constant(3000000, std::ldexp(std::round(std::ldexp(0.1, 43)), -43));
  Eigen::MatrixXd C(1, 1);
  segment_sums(V, X, C);
  EXPECT_TRUE(within_sums_bound(V, RowOrder::sorted, X, C));
  C(0, 0) = std::accumulate(X.begin(), X.end(), 0.0);
  EXPECT_FALSE(within_sums_bound(V, RowOrder::sorted, X, C));
}

TEST(SegmentSums, BoundFailsForRowsInTheWrongOrder) {
  const Segments V = random_segments(5000, 20, false, 54);
  const Eigen::MatrixXd X = random_matrix(5000, 1, 55);
  Eigen::MatrixXd C(20, 1);
  segment_sums(V, X, C, RowOrder::sorted);
  EXPECT_FALSE(within_sums_bound(V, RowOrder::scene, X, C));
}

TEST(SegmentSums, DoNotDependOnThreadsOrOtherColumns) {
  const Segments V = random_segments(100000, 40, true, 56);
  const Eigen::MatrixXd X = random_matrix(100000, 4, 57);
  Eigen::MatrixXd first(40, 4);
  segment_sums(V, X, first);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::MatrixXd again(40, 4);
    segment_sums(V, X, again);
    EXPECT_EQ(first, again) << threads;
  }
  Eigen::MatrixXd alone(40, 1);
  segment_sums(V, X.col(2), alone);
  EXPECT_EQ(alone, first.col(2));
}

TEST(SegmentSums, KeepInfiniteFieldsApart) {
  const Segments V({0, 300, 600});
  Eigen::MatrixXd X = Eigen::MatrixXd::Ones(600, 1);
  X(299, 0) = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd C(2, 1);
  segment_sums(V, X, C);
  EXPECT_EQ(C(0, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(C(1, 0), 300);
}

TEST(Segments, SortRowsAndKeepTheirOrder) {
  const Segments V = sort_by_segment({2, 0, 2, 0}, 3, {1, 2, 3, 4});
  EXPECT_EQ(V.offsets(), (std::vector<std::int64_t>{0, 2, 2, 4}));
  EXPECT_EQ(V.order(), (std::vector<std::int32_t>{1, 3, 0, 2}));
  EXPECT_EQ(V.weights(), (std::vector<double>{2, 4, 1, 3}));
}

TEST(Segments, RefuseWhatIsNoMatrix) {
  EXPECT_THROW(Segments({}), UsageError);
  EXPECT_THROW(Segments({1, 2}), UsageError);
  EXPECT_THROW(Segments({0, 3, 2}), UsageError);
  EXPECT_THROW(Segments({0, 2}, {1}), UsageError);
  EXPECT_THROW(Segments({0, 1}, {std::numeric_limits<double>::infinity()}), UsageError);
  EXPECT_THROW(Segments({0, 2}, {}, {0}), UsageError);
  EXPECT_THROW(Segments({0, 2}, {}, {0, 0}), UsageError);
  EXPECT_THROW(Segments({0, 2}, {}, {0, 2}), UsageError);
  EXPECT_THROW(sort_by_segment({0, 3}, 3), UsageError);
  EXPECT_THROW(sort_by_segment({-1}, 3), UsageError);
  EXPECT_THROW(sort_by_segment({0, 1}, 3, {1}), UsageError);
}

TEST(SegmentSums, RefuseShapesThatDoNotFit) {
  const Segments V({0, 2, 5});
  Eigen::MatrixXd two(2, 1);
  Eigen::MatrixXd five(5, 1);
  EXPECT_THROW(segment_sums(V, two, five), UsageError);
  EXPECT_THROW(spread_segments(V, five, two), UsageError);
}

/// Of stored numbers, so that only the sums differ.
template <typename Scalar>
void expect_right_segment_products(Index n, Index count, bool weighted) {
  const Segments V = random_segments(n, count, weighted, 71);
  RandomStream random(72);
  TallMatrix<Scalar> U(n, count, 0.5);
  Eigen::MatrixXd entries(n, count);
  Eigen::VectorXd diagonal(n);
  for (Index e = 0; e < n; ++e) {
    diagonal[e] = random.uniform(-1, 1);
    for (Index p = 0; p < count; ++p) {
      U.set(e, p, random.uniform(-1, 1));
      entries(e, p) = U(e, p);
    }
  }
  const Eigen::MatrixXd full = full_matrix(V, RowOrder::sorted);
  const Eigen::MatrixXd exact = entries.transpose() * diagonal.asDiagonal() * full;
  const Eigen::MatrixXd sizes =
      entries.cwiseAbs().transpose() * diagonal.cwiseAbs().asDiagonal() * full.cwiseAbs();
  const ThreadLimit one(1);
  const Eigen::MatrixXd products = transposed_segment_products(V, diagonal, U);
  EXPECT_TRUE(
      ((products - exact).cwiseAbs().array() <= 2 * static_cast<double>(n) * 0x1p-53 * sizes.array()).all());
  const ThreadLimit all(8);
  EXPECT_EQ(transposed_segment_products(V, diagonal, U), products);
}

TEST(SegmentProducts, AreThoseOfTheFullMatrices) {
  for (const bool weighted : {false, true}) {
    for (const Index n : {1, 5, 64, 65, 700}) expect_right_segment_products<double>(n, 9, weighted);
    expect_right_segment_products<float>(900, 40, weighted);
  }
}

TEST(SegmentProducts, ShapesThatDoNotFitAreRefused) {
  const Segments V = random_segments(30, 4, false, 73);
  EXPECT_THROW(transposed_segment_products(V, Eigen::VectorXd::Ones(29), TallMatrix<float>(30, 4)),
               UsageError);
  EXPECT_THROW(transposed_segment_products(V, Eigen::VectorXd::Ones(30), TallMatrix<float>(31, 4)),
               UsageError);
  EXPECT_THROW(transposed_segment_products(V, Eigen::VectorXd::Ones(30), TallMatrix<float>(30, 5)),
               UsageError);
}

}  // namespace
}  // namespace radiosity
