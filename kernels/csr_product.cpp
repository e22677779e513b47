#include "foundation/parallel.hpp"
#include "kernels/partial_sums.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"

#include <algorithm>
#include <vector>

namespace radiosity {
namespace {

using RowMajorField = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Sums that run side by side within a row, because an addition takes longer than a load. A row's entries go
/// to them in turn, so that a column's result is the same whatever the number of columns.
constexpr std::size_t sums_per_row = 4;

/// One column.
template <typename Scalar>
double dot_row(const CsrMatrix<Scalar>& M, Index row, const double* x) {
  const auto r = static_cast<std::size_t>(row);
  auto k = static_cast<std::size_t>(M.row_begin[r]);
  const auto end = static_cast<std::size_t>(M.row_begin[r + 1]);
  double sums[sums_per_row] = {};
  for (; k + sums_per_row <= end; k += sums_per_row)
    for (std::size_t s = 0; s < sums_per_row; ++s)
      sums[s] += static_cast<double>(M.value[k + s]) * x[M.column[k + s]];
  for (std::size_t s = 0; k < end; ++k, ++s) sums[s] += static_cast<double>(M.value[k]) * x[M.column[k]];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Y(row, :) for several columns; X by rows, so that what an entry multiplies lies together. `sums` has room
/// for sums_per_row times the columns.
template <typename Scalar>
void multiply_row(const CsrMatrix<Scalar>& M, Index row, const RowMajorField& X, std::vector<double>& sums,
                  FieldRef Y) {
  const auto columns = static_cast<std::size_t>(X.cols());
  std::fill(sums.begin(), sums.end(), 0.0);
  const auto begin = static_cast<std::size_t>(M.row_begin[static_cast<std::size_t>(row)]);
  const auto end = static_cast<std::size_t>(M.row_begin[static_cast<std::size_t>(row) + 1]);
  for (std::size_t k = begin; k < end; ++k) {
    const double* x = X.data() + static_cast<std::size_t>(M.column[k]) * columns;
    double* sum = sums.data() + (k - begin) % sums_per_row * columns;
    const auto value = static_cast<double>(M.value[k]);
    for (std::size_t c = 0; c < columns; ++c) sum[c] += value * x[c];
  }
  for (std::size_t c = 0; c < columns; ++c)
    Y(row, static_cast<Index>(c)) =
        (sums[c] + sums[columns + c]) + (sums[2 * columns + c] + sums[3 * columns + c]);
}

template <typename Scalar>
void multiply_sparse(const CsrMatrix<Scalar>& M, const ConstFieldRef& X, FieldRef Y) {
  check_product_shapes(M.rows(), M.cols, X, Y);
  const auto rows = static_cast<std::size_t>(M.rows());
  if (X.cols() == 1) {
    parallel_for(
        rows,
        [&](std::size_t i) { Y(static_cast<Index>(i), 0) = dot_row(M, static_cast<Index>(i), X.data()); },
        32);
    return;
  }
  const RowMajorField by_rows = X;
  constexpr std::size_t rows_at_once = 32;
  parallel_for((rows + rows_at_once - 1) / rows_at_once, [&](std::size_t group) {
    std::vector<double> sums(sums_per_row * static_cast<std::size_t>(X.cols()));
    for (std::size_t i = group * rows_at_once; i < std::min(rows, (group + 1) * rows_at_once); ++i)
      multiply_row(M, static_cast<Index>(i), by_rows, sums, Y);
  });
}

template <typename Scalar>
void multiply_sparse_transposed(const CsrMatrix<Scalar>& M, const ConstFieldRef& X, FieldRef Y) {
  check_product_shapes(M.cols, M.rows(), X, Y);
  const Index chunks = std::clamp<Index>(static_cast<Index>(M.value.size()) / 65536, 1, 16);
  const Index blocks = (M.cols + 63) / 64;
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Index columns = std::min(columns_at_once, X.cols() - first);
    PartialSums sums(blocks, columns, std::vector<Index>(static_cast<std::size_t>(chunks), 0));
    parallel_for(static_cast<std::size_t>(chunks), [&](std::size_t index) {
      const auto chunk = static_cast<Index>(index);
      sums.start(chunk);
      for (Index row = M.rows() * chunk / chunks; row < M.rows() * (chunk + 1) / chunks; ++row)
        for (auto k = M.row_begin[static_cast<std::size_t>(row)];
             k < M.row_begin[static_cast<std::size_t>(row) + 1]; ++k) {
          const Index column = M.column[static_cast<std::size_t>(k)];
          const auto value = static_cast<double>(M.value[static_cast<std::size_t>(k)]);
          double* y = sums.block(chunk, column / 64) + column % 64;
          for (Index c = 0; c < columns; ++c) y[64 * c] += value * X(row, first + c);
        }
    });
    sums.finish(1, first, Y);
  }
}

}  // namespace

void multiply(const CsrMatrix<double>& M, const ConstFieldRef& X, FieldRef Y) {
  multiply_sparse(M, X, Y);
}
void multiply(const CsrMatrix<float>& M, const ConstFieldRef& X, FieldRef Y) {
  multiply_sparse(M, X, Y);
}
void multiply_transposed(const CsrMatrix<double>& M, const ConstFieldRef& X, FieldRef Y) {
  multiply_sparse_transposed(M, X, Y);
}
void multiply_transposed(const CsrMatrix<float>& M, const ConstFieldRef& X, FieldRef Y) {
  multiply_sparse_transposed(M, X, Y);
}

}  // namespace radiosity
