#include "kernels/row_groups.hpp"

#include "kernels/side_by_side_rows.hpp"

#include <bit>

namespace radiosity {

template <typename Scalar>
RowGroups<Scalar>::RowGroups(const CsrMatrix<Scalar>& matrix) : rows_(matrix.rows()), cols_(matrix.cols) {
  values_.reserve(matrix.value.size() + readable_beyond);
  for (Index g = 0; g < groups(); ++g) {
    const std::size_t begin = columns_.size();
    visit_side_by_side<rows_of_group>(matrix, g * rows_of_group,
                                      [&](std::int32_t column, std::size_t row, std::size_t entry) {
                                        if (columns_.size() == begin || columns_.back() != column) {
                                          columns_.push_back(column);
                                          masks_.push_back(0);
                                        }
                                        masks_.back() = static_cast<std::uint16_t>(masks_.back() | 1U << row);
                                        values_.push_back(matrix.value[entry]);
                                      });
    begin_.push_back(columns_.size());
    value_begin_.push_back(values_.size());
  }
  columns_.shrink_to_fit();
  masks_.shrink_to_fit();
  values_.resize(values_.size() + readable_beyond);
}

template <typename Scalar>
CsrMatrix<Scalar> RowGroups<Scalar>::compressed_rows() const {
  CsrMatrix<Scalar> matrix;
  matrix.cols = cols_;
  matrix.column.reserve(entries());
  matrix.value.reserve(entries());
  for (Index row = 0; row < rows_; ++row) {
    const Group own = group(row / rows_of_group);
    const unsigned bit = 1U << row % rows_of_group;
    const Scalar* values = own.values;
    for (std::size_t e = 0; e < own.elements; ++e) {
      const unsigned mask = own.masks[e];
      if ((mask & bit) != 0) {
        matrix.column.push_back(own.columns[e]);
        matrix.value.push_back(values[std::popcount(mask & (bit - 1))]);
      }
      values += std::popcount(mask);
    }
    matrix.row_begin.push_back(static_cast<std::int64_t>(matrix.column.size()));
  }
  return matrix;
}

template class RowGroups<float>;
template class RowGroups<double>;

}  // namespace radiosity
