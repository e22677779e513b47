#pragma once

#include "kernels/instruction_set.hpp"

#include <cstddef>
#include <cstdint>

// The innermost loops of texture products, one translation unit an instruction set. This header is read by
// files that are compiled for wider vectors than the rest of the program and so includes nothing that defines
// inline functions of any weight.

namespace radiosity {

constexpr int texture_table = 64;          ///< numbers from one channel's table to the next
constexpr float texture_third = 1.0F / 3;  ///< what linear palettes multiply with

/// Columns of a texture (kernels/colour_texture.hpp) that are worked on together, and their order: 16 blocks
/// of four columns are turned into four vectors of four blocks, so that number 16 k + 4 l + c of a group of
/// 64 is column 16 l + 4 k + c.
constexpr int texture_group = 64;
constexpr int texture_group_column(int place) {
  return place % 16 / 4 * 16 + place / 16 * 4 + place % 4;
}

/// What a column of blocks multiplies in one channel of a linear texture: 16 sums w x of its first two
/// columns by both indices (the second's above the first's), 16 of the last two, the sum of all four,
/// padding.
constexpr int linear_numbers = 48;

/// A run of groups of a row of blocks with the numbers that they are multiplied with.
struct TextureTask {
  const std::uint64_t* blocks = nullptr;  ///< 16 a group
  int groups = 0;
  const float* tables = nullptr;  ///< of the colour channels
  bool logarithmic = false;

  /// To rows: y(r, channel) at y_rows[4 channel + r] += M x, with x of a group at x + 64 channels group + 64
  /// channel, in the group's order.
  const float* x = nullptr;
  double* y_rows = nullptr;

  /// To columns: y of a group, laid out as x is above, += M' x, with x(r, channel) at x_rows[4 channel + r].
  const float* x_rows = nullptr;
  float* y = nullptr;
};

/// Sixteen rows of blocks of a linear texture.
struct LinearStrip {
  const std::uint64_t* blocks = nullptr;
  std::ptrdiff_t row_stride = 0;    ///< blocks from one row of blocks to the next
  int block_columns = 0;            ///< a multiple of 8
  const float* weighted = nullptr;  ///< linear_numbers a channel, the channels of a column of blocks together
  double* y = nullptr;              ///< y(r, channel) of row of blocks b at y[64 channel + 16 r + b] += M x
};

/// Functions for 1 channel at [0] and 3 at [1].
struct TextureProducts {
  using Function = void (*)(const TextureTask&);
  Function to_rows[2] = {};
  Function to_columns[2] = {};
  /// to_rows of linear textures: indices look up sums of x that are weighted already, so that texels count as
  /// theirs to rounding, not to the bit, and 0 as 0. Null where there is nothing faster.
  using StripFunction = void (*)(const LinearStrip&);
  StripFunction linear_strip[2] = {};
};

TextureProducts texture_products(InstructionSet instructions);

void get_baseline_texture_products(TextureProducts& products);
void get_avx2_texture_products(TextureProducts& products);
void get_avx512_texture_products(TextureProducts& products);

}  // namespace radiosity
