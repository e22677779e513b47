#include "gpu/row_fours.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace radiosity {
namespace {

constexpr Index rows_of_four = 4;
constexpr std::size_t least_entries_of_four = 2;

/// Calls add(column, r, i) for the entries of four rows: by columns, and those of a column by rows. r: of the
/// four; i: of the matrix' entries.
template <typename Scalar, typename Add>
void for_entries_of_four(const CsrMatrix<Scalar>& matrix, Index first_row, const Add& add) {
  const Index rows = std::min(rows_of_four, matrix.rows() - first_row);
  std::array<std::size_t, rows_of_four> at{};
  std::array<std::size_t, rows_of_four> end{};
  for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r) {
    at[r] = static_cast<std::size_t>(matrix.row_begin[static_cast<std::size_t>(first_row) + r]);
    end[r] = static_cast<std::size_t>(matrix.row_begin[static_cast<std::size_t>(first_row) + r + 1]);
  }
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  for (;;) {
    std::int32_t column = none;
    for (std::size_t r = 0; r < at.size(); ++r)
      if (at[r] < end[r]) column = std::min(column, matrix.column[at[r]]);
    if (column == none) return;
    for (std::size_t r = 0; r < at.size(); ++r)
      if (at[r] < end[r] && matrix.column[at[r]] == column) add(column, r, at[r]++);
  }
}

template <typename Scalar>
std::size_t count_fours(const CsrMatrix<Scalar>& matrix) {
  std::size_t count = 0;
  for (Index first = 0; first < matrix.rows(); first += rows_of_four) {
    std::int32_t last = -1;
    for_entries_of_four(matrix, first, [&](std::int32_t column, std::size_t, std::size_t) {
      if (column != last) ++count;
      last = column;
    });
  }
  return count;
}

}  // namespace

template <typename Scalar>
std::optional<CsrMatrix<Scalar>> row_fours(const CsrMatrix<Scalar>& matrix) {
  const std::size_t count = count_fours(matrix);
  if (matrix.value.empty() || matrix.value.size() < least_entries_of_four * count) return std::nullopt;
  CsrMatrix<Scalar> fours;
  fours.cols = matrix.cols;
  fours.column.reserve(count);
  fours.value.reserve(rows_of_four * count);
  for (Index first = 0; first < matrix.rows(); first += rows_of_four) {
    const std::size_t begin = fours.column.size();
    for_entries_of_four(matrix, first, [&](std::int32_t column, std::size_t r, std::size_t i) {
      if (fours.column.size() == begin || fours.column.back() != column) {
        fours.column.push_back(column);
        fours.value.resize(fours.value.size() + rows_of_four);
      }
      fours.value[fours.value.size() - rows_of_four + r] = matrix.value[i];
    });
    fours.row_begin.push_back(static_cast<std::int64_t>(fours.column.size()));
  }
  return fours;
}

template std::optional<CsrMatrix<float>> row_fours(const CsrMatrix<float>&);
template std::optional<CsrMatrix<double>> row_fours(const CsrMatrix<double>&);

}  // namespace radiosity
