#pragma once

#include "kernels/half.hpp"
#include "kernels/instruction_set.hpp"
#include "kernels/tile_format.hpp"

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

/// Tile columns whose products with one tile row may be added up in float before they go to double, and for
/// which X has one scale.
constexpr int tiles_together = 4;

/// The pieces of X and Y that a tile touches, in blocks of 64 rows, one column after the other: entry (i, c)
/// of a block is at 64 c + i. All are aligned to 64 bytes.
template <typename Number>
struct TileFields {
  // y_rows += entries x_columns: tasks with the same rows form runs that add up in `row_lanes`.
  const Number* x_columns = nullptr;
  const double* x_columns_scale =
      nullptr;                  ///< what x_columns is to be multiplied by, one a column; the same in a run
  Number* row_lanes = nullptr;  ///< room for 16 numbers (8 for double) a row and column; kept within a run
  bool first = true;            ///< begins a run: what is in row_lanes is not read
  bool last = true;             ///< ends a run: its sums are added to y_rows
  double* y_rows = nullptr;

  // y_columns += entries' x_rows.
  const Number* x_rows = nullptr;
  const double* x_rows_scale = nullptr;
  double* y_columns = nullptr;
};

/// At most 64 rows of 64 entries of a matrix, aligned to 64 bytes. Where Scalar is Bc4Block, the entries are
/// those of 16 x 16 blocks, which follow each other by rows.
template <typename Scalar>
struct TileTask : TileFields<typename Multiplier<Scalar>::Type> {
  using Fields = TileFields<typename Multiplier<Scalar>::Type>;

  TileTask() = default;
  explicit TileTask(const Fields& fields) : Fields(fields) {}

  const Scalar* entries = nullptr;
  std::ptrdiff_t stride = 64;        ///< numbers from one row to the next; not for blocks
  int rows = 64;                     ///< 64 for blocks
  const TileCurve* curve = nullptr;  ///< for blocks: what their codes stand for
  const char* prefetch =
      nullptr;  ///< what will be read soon, as much as this task reads; null: do not fetch ahead
  bool prefetch_every_line = true;  ///< else one line a row, where entries follow each other in memory
};

/// Functions for 1, 2 and 3 columns at [columns - 1]; more do not fit into the registers.
template <typename Scalar>
struct TileProducts {
  static constexpr int most_columns = 3;
  using Function = void (*)(const TileTask<Scalar>&);

  Function both[most_columns] = {};        ///< y_rows and y_columns with one read of the entries
  Function to_rows[most_columns] = {};     ///< y_rows only
  Function to_columns[most_columns] = {};  ///< y_columns only
};

/// Numbers of row_lanes that the functions use at most.
template <typename Scalar>
constexpr int row_lanes_size = TileProducts<Scalar>::most_columns * 64 *
                               (64 / static_cast<int>(sizeof(typename Multiplier<Scalar>::Type)));

template <typename Scalar>
TileProducts<Scalar> tile_products(InstructionSet instructions);

/// Products that decode BC4 blocks while they multiply: the same bits as tile_products<float> of what a
/// decoder (kernels/tile_decoders.hpp) makes of them. Null functions where that is not faster (all but
/// AVX-512).
TileProducts<Bc4Block> bc4_products(InstructionSet instructions, const TileCurve& curve);

void get_baseline_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16);
void get_avx2_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16);
void get_avx512_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16);
void get_avx512_products(TileProducts<Bc4Block>& linear, TileProducts<Bc4Block>& logarithmic);

}  // namespace radiosity
