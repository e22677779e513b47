// Y = M X for COLUMNS columns and a sparse M by compressed rows, one or four of them TOGETHER (gpu/row_fours.hpp). LANES
// of the INVOCATIONS of a work group walk along a row, or along four, side by side; with one there is nothing to put
// together. ADDS: Y += M X. DOUBLE: in that precision.
#include "groups.glsl"
#include "number.glsl"

layout(local_size_x = INVOCATIONS) in;

const uint ROWS = INVOCATIONS / LANES;

#if TOGETHER == 1
#define NUMBERS NUMBER
#elif DOUBLE
#define NUMBERS dvec4
#else
#define NUMBERS vec4
#endif

layout(std430, binding = 0) readonly buffer Values { NUMBERS values[]; };
layout(std430, binding = 3) readonly buffer Columns { uint columns[]; };  // NARROW: two to a number, the first below
layout(std430, binding = 4) readonly buffer RowBegin { uint row_begin[]; };
layout(std430, binding = 1) readonly buffer X { NUMBER x[]; };
layout(std430, binding = 2) buffer Y { NUMBER y[]; };

uniform uint first_row;   // of the matrix in this block of storage, in TOGETHER of them as the next
uniform uint block_rows;
uniform uint x_stride;    // between columns
uniform uint y_stride;
uniform uint first_column;
uniform uint column_step;

uint column_of(uint i) {
#if NARROW
  return bitfieldExtract(columns[i / 2], int(i % 2) * 16, 16);
#else
  return columns[i];
#endif
}

void write_number(uint place, NUMBER number) {
#if ADDS
  number += y[place];
#endif
  y[place] = number;
}

void write_sum(uint c, uint row, NUMBERS sum) {
  uint place = (first_column + c * column_step) * y_stride + (first_row + row) * TOGETHER;
#if TOGETHER == 1
  write_number(place, sum);
#else
  for (uint r = 0; r < TOGETHER; ++r) write_number(place + r, sum[r]);
#endif
}

#if LANES > 1
shared NUMBERS sums[COLUMNS][INVOCATIONS];
#endif

void main() {
  uint lane = gl_LocalInvocationID.x % LANES;
  uint row = group_index() * ROWS + gl_LocalInvocationID.x / LANES;
  bool present = row < block_rows;
  uint end = present ? row_begin[row + 1] : 0;
  NUMBERS sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = NUMBERS(0);
  for (uint i = present ? row_begin[row] + lane : 0; i < end; i += LANES) {
    NUMBERS value = values[i];
    uint column = column_of(i);
    for (uint c = 0; c < COLUMNS; ++c) sum[c] += value * x[(first_column + c * column_step) * x_stride + column];
  }
#if LANES > 1
  for (uint c = 0; c < COLUMNS; ++c) sums[c][gl_LocalInvocationID.x] = sum[c];
  for (uint width = LANES / 2; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < COLUMNS; ++c) sums[c][gl_LocalInvocationID.x] += sums[c][gl_LocalInvocationID.x + width];
  }
  barrier();
  if (present && lane < COLUMNS) write_sum(lane, row, sums[lane][gl_LocalInvocationID.x - lane]);
#else
  if (present)
    for (uint c = 0; c < COLUMNS; ++c) write_sum(c, row, sum[c]);
#endif
}
