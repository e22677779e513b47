#include "kernels/csr_matrix.hpp"

#include <numeric>

namespace radiosity {
namespace {

/// Calls visit(row, column, value) for every stored number of both halves, columns rising within each row.
template <typename Visit>
void visit_entries(const SymmetricTiles<double>& tiles, const Visit& visit) {
  constexpr Index size = SymmetricTiles<double>::tile_size;
  for (Index I = 0; I < tiles.tile_rows(); ++I)
    for (Index tile = tiles.row_begin(I); tile < tiles.row_begin(I + 1); ++tile) {
      const Index J = tiles.tile_column(tile);
      const double* entries = tiles.tile_data(tile);
      for (Index r = 0; r < size; ++r)
        for (Index c = 0; c < size; ++c) {
          const double value = tiles.scale() * entries[r * size + c];
          visit(I * size + r, J * size + c, value);
          if (I != J) visit(J * size + c, I * size + r, value);
        }
    }
}

template <typename Visit>
void visit_entries(const RowMajorMatrix<double>& matrix, const Visit& visit) {
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) visit(i, j, matrix(i, j));
}

template <typename Scalar, typename Matrix>
CsrMatrix<Scalar> compress_rows(const Matrix& matrix, Index rows, Index cols) {
  CsrMatrix<Scalar> result;
  result.cols = cols;
  result.row_begin.assign(static_cast<std::size_t>(rows) + 1, 0);
  visit_entries(matrix, [&](Index row, Index, double value) {
    if (static_cast<Scalar>(value) != 0) ++result.row_begin[static_cast<std::size_t>(row) + 1];
  });
  std::partial_sum(result.row_begin.begin(), result.row_begin.end(), result.row_begin.begin());
  result.column.resize(static_cast<std::size_t>(result.row_begin.back()));
  result.value.resize(result.column.size());
  std::vector<std::int64_t> next(result.row_begin.begin(), result.row_begin.end() - 1);
  visit_entries(matrix, [&](Index row, Index column, double value) {
    if (static_cast<Scalar>(value) == 0) return;
    const auto k = static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++);
    result.column[k] = static_cast<std::int32_t>(column);
    result.value[k] = static_cast<Scalar>(value);
  });
  return result;
}

}  // namespace

template <typename Scalar>
CsrMatrix<Scalar> compress(const SymmetricTiles<double>& tiles) {
  return compress_rows<Scalar>(tiles, tiles.size(), tiles.size());
}

template <typename Scalar>
CsrMatrix<Scalar> compress(const RowMajorMatrix<double>& matrix) {
  return compress_rows<Scalar>(matrix, matrix.rows(), matrix.cols());
}

template CsrMatrix<double> compress(const SymmetricTiles<double>&);
template CsrMatrix<float> compress(const SymmetricTiles<double>&);
template CsrMatrix<double> compress(const RowMajorMatrix<double>&);
template CsrMatrix<float> compress(const RowMajorMatrix<double>&);

}  // namespace radiosity
