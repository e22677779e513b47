#pragma once

#include "kernels/instruction_set.hpp"

#include <cstddef>
#include <cstdint>

// The innermost loops of products with RowGroups, one translation unit an instruction set. This header is
// read by files that are compiled for wider vectors than the rest of the program and so includes nothing that
// defines inline functions of any weight.

namespace radiosity {

/// A group of 16 rows (kernels/row_groups.hpp) and the numbers that it is multiplied with.
template <typename Scalar>
struct RowGroupTask {
  const Scalar* values = nullptr;
  const std::int32_t* columns = nullptr;
  const std::uint16_t* masks = nullptr;
  std::size_t elements = 0;

  /// To rows: y(r, c) at y_rows[16 c + r] = M x, with x(j, c) at x[columns j + c].
  const double* x = nullptr;
  double* y_rows = nullptr;

  /// To columns: y(j, c) at y[columns j + c] += M' x, with x(r, c) at x_rows[16 c + r].
  const double* x_rows = nullptr;
  double* y = nullptr;
};

/// Functions for 1, 2 and 3 columns at [columns - 1].
template <typename Scalar>
struct RowGroupProducts {
  static constexpr int most_columns = 3;
  using Function = void (*)(const RowGroupTask<Scalar>&);
  Function to_rows[most_columns] = {};
  Function to_columns[most_columns] = {};
};

void get_baseline_row_group_products(RowGroupProducts<double>& f64, RowGroupProducts<float>& f32);
void get_avx2_row_group_products(RowGroupProducts<double>& f64, RowGroupProducts<float>& f32);
void get_avx512_row_group_products(RowGroupProducts<double>& f64, RowGroupProducts<float>& f32);

}  // namespace radiosity
