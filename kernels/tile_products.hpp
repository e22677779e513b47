#pragma once

#include "kernels/half.hpp"
#include "kernels/instruction_set.hpp"

#include <array>
#include <cstddef>

// The innermost loops, one translation unit an instruction set. This header is read by files that are
// compiled for wider vectors than the rest of the program and so includes nothing that defines inline
// functions of any weight.

namespace radiosity {

/// The type that entries stored as Scalar multiply in: double for double, else float.
template <typename Scalar>
struct Multiplier {
  using Type = float;
};
template <>
struct Multiplier<double> {
  using Type = double;
};

/// At most 64 rows of 64 entries of a matrix and the pieces of X and Y that they touch. X and Y are in blocks
/// of 64 rows, one column after the other: entry (i, c) of a block is at 64 c + i. All are aligned to 64
/// bytes.
template <typename Scalar>
struct TileTask {
  using Number = typename Multiplier<Scalar>::Type;

  const Scalar* entries = nullptr;
  std::ptrdiff_t stride = 64;  ///< numbers from one row to the next
  int rows = 64;
  const char* prefetch =
      nullptr;  ///< what will be read soon, as much as this task reads; null: do not fetch ahead

  const Number* x_columns = nullptr;        ///< block of X that belongs to the entries' columns ...
  const double* x_columns_scale = nullptr;  ///< ... to be multiplied by this, one a column of X
  double* y_rows = nullptr;                 ///< += entries * x_columns

  const Number* x_rows = nullptr;  ///< block of X that belongs to the entries' rows
  const double* x_rows_scale = nullptr;
  double* y_columns = nullptr;  ///< += entries' * x_rows
};

/// Functions for 1 ... 4 columns at [columns - 1].
template <typename Scalar>
struct TileProducts {
  static constexpr int most_columns = 4;
  using Function = void (*)(const TileTask<Scalar>&);

  std::array<Function, most_columns> both{};        ///< y_rows and y_columns with one read of the entries
  std::array<Function, most_columns> to_rows{};     ///< y_rows only
  std::array<Function, most_columns> to_columns{};  ///< y_columns only
};

template <typename Scalar>
TileProducts<Scalar> tile_products(InstructionSet instructions);

void get_baseline_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16);
void get_avx2_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16);
void get_avx512_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16);

}  // namespace radiosity
