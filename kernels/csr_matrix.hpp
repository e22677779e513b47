#pragma once

#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// A sparse m x n matrix by compressed rows: row i owns the entries row_begin[i] ... row_begin[i + 1] - 1.
template <typename Scalar>
struct CsrMatrix {
  Index cols = 0;
  std::vector<std::int64_t> row_begin = {0};
  std::vector<std::int32_t> column;
  std::vector<Scalar> value;

  Index rows() const { return static_cast<Index>(row_begin.size()) - 1; }
  std::size_t value_bytes() const { return value.size() * sizeof(Scalar); }
  std::size_t index_bytes() const {
    return column.size() * sizeof(std::int32_t) + row_begin.size() * sizeof(std::int64_t);
  }
};

/// The entries that are not zero in the stored type, columns rising within a row; of a symmetric matrix both
/// halves.
template <typename Scalar>
CsrMatrix<Scalar> compress(const SymmetricTiles<double>& tiles);
template <typename Scalar>
CsrMatrix<Scalar> compress(const RowMajorMatrix<double>& matrix);

}  // namespace radiosity
