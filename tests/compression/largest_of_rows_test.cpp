#include "compression/largest_of_rows.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace radiosity {
namespace {

using RowsOfFloats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A third of it zeros, with many ties.
RowsOfFloats numbers_with_ties(Index rows, Index cols) {
  RandomStream random(6);
  return RowsOfFloats::NullaryExpr(
      rows, cols, [&] { return static_cast<float>(std::max(0.0, std::floor(random.uniform(-10, 20)))); });
}

TEST(LargestOfRows, TakesTheLargestAndOfEqualsTheFirst) {
  RowsOfFloats matrix(3, 5);
  matrix << 1, 5, 3, 5, 5,  //
      0, 0, 2, 0, 0,        //
      4, 4, 4, 4, 4;
  const CsrMatrix<float> largest = largest_of_rows(matrix, 0.4);
  EXPECT_EQ(largest.cols, 5);
  EXPECT_EQ(largest.row_begin, (std::vector<std::int64_t>{0, 2, 3, 5}));
  EXPECT_EQ(largest.column, (std::vector<std::int32_t>{1, 3, 2, 0, 1}));
  EXPECT_EQ(largest.value, (std::vector<float>{5, 5, 2, 4, 4}));
}

TEST(LargestOfRows, AgreesWithSortingEachRow) {
  const RowsOfFloats matrix = numbers_with_ties(20, 77);
  for (const double fraction : {0.0, 0.04, 0.3, 1.0}) {
    const CsrMatrix<float> largest = largest_of_rows(matrix, fraction);
    const auto count = static_cast<std::size_t>(std::floor(fraction * 77 + 0.5));
    for (Index i = 0; i < matrix.rows(); ++i) {
      std::vector<std::int32_t> columns;
      for (std::int32_t j = 0; j < 77; ++j)
        if (matrix(i, j) > 0) columns.push_back(j);
      std::stable_sort(columns.begin(), columns.end(),
                       [&](std::int32_t a, std::int32_t b) { return matrix(i, a) > matrix(i, b); });
      columns.resize(std::min(count, columns.size()));
      std::sort(columns.begin(), columns.end());
      const auto begin = largest.row_begin[static_cast<std::size_t>(i)];
      const auto end = largest.row_begin[static_cast<std::size_t>(i) + 1];
      EXPECT_EQ(std::vector(largest.column.begin() + begin, largest.column.begin() + end), columns);
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
        EXPECT_EQ(largest.value[k], matrix(i, largest.column[k]));
    }
  }
}

TEST(LargestOfRows, CountsAreRoundedHalvesUp) {
  const auto count = [](Index cols, double fraction) {
    return largest_of_rows(RowsOfFloats::Ones(1, cols), fraction).column.size();
  };
  EXPECT_EQ(count(12, 0.04), 0U);  // 0.48
  EXPECT_EQ(count(13, 0.04), 1U);  // 0.52
  EXPECT_EQ(count(10, 0.25), 3U);  // 2.5
  EXPECT_EQ(count(100, 0.04), 4U);
  EXPECT_EQ(count(7, 1), 7U);
}

TEST(LargestOfRows, WorksOnEmptyMatricesAndParts) {
  EXPECT_EQ(largest_of_rows(RowsOfFloats(0, 0), 0.5).rows(), 0);
  EXPECT_EQ(largest_of_rows(RowsOfFloats(3, 0), 0.5).row_begin, (std::vector<std::int64_t>{0, 0, 0, 0}));
  EXPECT_TRUE(largest_of_rows(RowsOfFloats::Zero(4, 9), 1).column.empty());
  const RowsOfFloats matrix = numbers_with_ties(6, 30);
  const RowsOfFloats part = matrix.block(2, 5, 3, 20);
  EXPECT_EQ(largest_of_rows(matrix.block(2, 5, 3, 20), 0.2).column, largest_of_rows(part, 0.2).column);
}

TEST(LargestOfRows, DoesNotDependOnThreads) {
  const RowsOfFloats matrix = numbers_with_ties(100, 50);
  const CsrMatrix<float> first = largest_of_rows(matrix, 0.1);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    const CsrMatrix<float> again = largest_of_rows(matrix, 0.1);
    EXPECT_EQ(again.column, first.column);
    EXPECT_EQ(again.value, first.value);
  }
}

TEST(LargestOfRows, RefusesWhatItCannotCompare) {
  RowsOfFloats matrix = RowsOfFloats::Ones(4, 4);
  for (const double fraction : {-0.1, 1.1, std::nan("")})
    EXPECT_THROW(largest_of_rows(matrix, fraction), UsageError);
  for (const float wrong : {-1.0F, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    matrix(2, 3) = wrong;
    EXPECT_THROW(largest_of_rows(matrix, 0.5), Error) << wrong;
  }
}

}  // namespace
}  // namespace radiosity
