// Y = M X for COLUMNS columns and a matrix in tiles of 16 x 16 blocks of 4 x 4 numbers, which are decoded here. LANES of
// the INVOCATIONS of a work group share four rows: they walk along the blocks of all their tiles side by side. SYMMETRIC:
// of the matrix half is stored, and a tile may stand for its transpose.
#include "groups.glsl"
#include "tile_codes.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = 1) readonly buffer X { vec4 x[]; };  // by columns, each of 16 tile_rows
layout(std430, binding = 2) buffer Y { float y[]; };          // by columns, each of 64 tile_rows
layout(std430, binding = 3) readonly buffer Places { uvec2 places[]; };  // a tile; twice its column, plus 1: transposed
layout(std430, binding = 4) readonly buffer RowBegin { uint row_begin[]; };

uniform uint tile_rows;
uniform uint adds;  // 1: Y += M X
uniform uint first_column;
uniform uint column_step;
uniform uint scale_bits;  // a float, as its bits

#define SUMS COLUMNS
#include "four_row_sums.glsl"

void write_sum(uint c, uint row, float sum) {
  uint place = (first_column + c * column_step) * tile_rows * 64 + row;
  float before = adds == 1 ? y[place] : 0;
  y[place] = before + uintBitsToFloat(scale_bits) * sum;
}

// Invocations that walk along one tile.
const uint TOGETHER = LANES < 16 ? LANES : 16;

void main() {
  uint lane = gl_LocalInvocationID.x % LANES;
  uint block_row = group_index() * (INVOCATIONS / LANES) + gl_LocalInvocationID.x / LANES;
  bool present = block_row < 16 * tile_rows;
  uint tile_row = block_row / 16;
  uint own = block_row % 16;
  vec4 sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = vec4(0);
  uint end = present ? row_begin[tile_row + 1] : 0;
  for (uint k = present ? row_begin[tile_row] + lane / TOGETHER : 0; k < end; k += LANES / TOGETHER) {
    uvec2 place = places[k];
    uint tile_column = place.y / 2;
    for (uint other = lane % TOGETHER; other < 16; other += TOGETHER) {
#if SYMMETRIC
      bool transposed = place.y % 2 == 1;
      mat4 numbers = block_numbers(place.x, transposed ? other : own, transposed ? own : other);
#else
      mat4 numbers = block_numbers(place.x, own, other);
#endif
      for (uint c = 0; c < COLUMNS; ++c) {
        vec4 part = x[((first_column + c * column_step) * tile_rows + tile_column) * 16 + other];
#if SYMMETRIC
        sum[c] += transposed ? numbers * part : part * numbers;
#else
        sum[c] += part * numbers;
#endif
      }
    }
  }
  write_four_rows(sum, present, block_row * 4);
}
