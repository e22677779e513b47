#include "compression/largest_of_rows.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiosity {
namespace {

using Columns = std::vector<std::int32_t>;

Columns largest_of_row(const float* row, Index row_number, std::int32_t cols, std::size_t count) {
  Columns columns;
  for (std::int32_t j = 0; j < cols; ++j) {
    if (!(row[j] >= 0 && std::isfinite(row[j])))
      fail("entry [{}, {}] is {}; it must be finite and not negative", row_number, j, row[j]);
    if (row[j] > 0) columns.push_back(j);
  }
  if (columns.size() > count) {
    const auto end = columns.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(columns.begin(), end, columns.end(), [row](std::int32_t a, std::int32_t b) {
      return row[a] != row[b] ? row[a] > row[b] : a < b;
    });
    columns.erase(end, columns.end());
    std::sort(columns.begin(), columns.end());
  }
  return columns;
}

}  // namespace

CsrMatrix<float> largest_of_rows(
    const Eigen::Ref<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& matrix,
    double fraction) {
  if (!(fraction >= 0 && fraction <= 1))
    fail<UsageError>("a fraction of {} of each row is asked for; it must be from 0 to 1", fraction);
  const auto cols = static_cast<std::int32_t>(matrix.cols());
  const auto count = static_cast<std::size_t>(std::llround(fraction * static_cast<double>(cols)));
  std::vector<Columns> largest(static_cast<std::size_t>(matrix.rows()));
  parallel_for(largest.size(), [&](std::size_t row) {
    const auto i = static_cast<Index>(row);
    largest[row] = largest_of_row(matrix.data() + i * matrix.outerStride(), i, cols, count);
  });
  CsrMatrix<float> result;
  result.cols = matrix.cols();
  for (std::size_t row = 0; row < largest.size(); ++row) {
    for (const std::int32_t j : largest[row]) {
      result.column.push_back(j);
      result.value.push_back(matrix(static_cast<Index>(row), j));
    }
    result.row_begin.push_back(static_cast<std::int64_t>(result.column.size()));
  }
  return result;
}

}  // namespace radiosity
