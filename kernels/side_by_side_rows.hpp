#pragma once

#include "kernels/csr_matrix.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace radiosity {

/// Calls visit(column, r, i) for the entries of the rows first_row + r, r < `together`, as far as there are
/// rows: by columns, and those of a column by rows. i: which of the matrix' entries it is. Columns rise
/// within the rows of `matrix`.
template <Index together, typename Scalar, typename Visit>
void visit_side_by_side(const CsrMatrix<Scalar>& matrix, Index first_row, const Visit& visit) {
  const auto rows = static_cast<std::size_t>(std::min(together, matrix.rows() - first_row));
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  std::array<std::size_t, static_cast<std::size_t>(together)> at{};
  std::array<std::int32_t, static_cast<std::size_t>(together)> next{};
  const auto begin = matrix.row_begin.begin() + first_row;
  const auto next_of = [&](std::size_t r) {
    return at[r] < static_cast<std::size_t>(begin[static_cast<std::ptrdiff_t>(r) + 1]) ? matrix.column[at[r]]
                                                                                       : none;
  };
  for (std::size_t r = 0; r < rows; ++r) {
    at[r] = static_cast<std::size_t>(begin[static_cast<std::ptrdiff_t>(r)]);
    next[r] = next_of(r);
  }
  for (;;) {
    const std::int32_t column = *std::min_element(next.begin(), next.begin() + rows);
    if (column == none) return;
    for (std::size_t r = 0; r < rows; ++r)
      if (next[r] == column) {
        visit(column, r, at[r]++);
        next[r] = next_of(r);
      }
  }
}

}  // namespace radiosity
