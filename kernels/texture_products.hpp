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

/// The order that linear_to_rows wants: number 16 c + b of a group of 64 is column 4 b + c, column c of block
/// b.
constexpr int linear_group_column(int place) {
  return place % 16 * 4 + place / 16;
}

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

/// Functions for 1 channel at [0] and 3 at [1].
struct TextureProducts {
  using Function = void (*)(const TextureTask&);
  Function to_rows[2] = {};
  Function to_columns[2] = {};
  /// to_rows of linear textures with x in another order: weights of indices are summed before they meet the
  /// colours, so that texels count as theirs to rounding, not to the bit, and 0 as 0. Null where there is
  /// nothing faster.
  Function linear_to_rows[2] = {};
};

TextureProducts texture_products(InstructionSet instructions);

void get_baseline_texture_products(TextureProducts& products);
void get_avx2_texture_products(TextureProducts& products);
void get_avx512_texture_products(TextureProducts& products);

}  // namespace radiosity
