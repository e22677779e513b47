#include "kernels/row_groups.hpp"

#include "kernels/side_by_side_rows.hpp"

#include <numeric>

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
  matrix.row_begin.assign(static_cast<std::size_t>(rows_) + 1, 0);
  visit_entries([&](Index row, Index, Scalar) { ++matrix.row_begin[static_cast<std::size_t>(row) + 1]; });
  std::partial_sum(matrix.row_begin.begin(), matrix.row_begin.end(), matrix.row_begin.begin());
  matrix.column.resize(entries());
  matrix.value.resize(entries());
  std::vector<std::int64_t> next(matrix.row_begin.begin(), matrix.row_begin.end() - 1);
  visit_entries([&](Index row, Index column, Scalar value) {
    const auto k = static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++);
    matrix.column[k] = static_cast<std::int32_t>(column);
    matrix.value[k] = value;
  });
  return matrix;
}

template class RowGroups<float>;
template class RowGroups<double>;

}  // namespace radiosity
