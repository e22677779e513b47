// Y = M X for COLUMNS columns in double precision. LANES of the INVOCATIONS of a work group walk along a row side by side.
#include "groups.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = 0) readonly buffer Entries { dvec4 entries[]; };  // by rows
layout(std430, binding = 1) readonly buffer X { dvec4 x[]; };              // by columns, each of row_quads
layout(std430, binding = 2) writeonly buffer Y { double y[]; };            // by columns, each of y_stride

uniform uint row_quads;     // fours of entries in a row
uniform uint first_row;     // of the matrix in this block of storage
uniform uint block_rows;
uniform uint y_stride;
uniform uint first_column;  // of X and Y, of COLUMNS

#if LANES > 1
shared double sums[COLUMNS][INVOCATIONS];
#endif

void main() {
  uint place = gl_LocalInvocationID.x;
  uint lane = place % LANES;
  uint row = group_index() * (INVOCATIONS / LANES) + place / LANES;
  bool present = row < block_rows;
  double sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = 0;
  uint end = present ? row_quads : 0;
  for (uint quad = lane; quad < end; quad += LANES) {
    dvec4 four = entries[row * row_quads + quad];
    for (uint c = 0; c < COLUMNS; ++c) sum[c] += dot(four, x[(first_column + c) * row_quads + quad]);
  }
#if LANES > 1
  for (uint c = 0; c < COLUMNS; ++c) sums[c][place] = sum[c];
  for (uint width = LANES / 2; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < COLUMNS; ++c) sums[c][place] += sums[c][place + width];
  }
  barrier();
  if (present && lane < COLUMNS) y[(first_column + lane) * y_stride + first_row + row] = sums[lane][place - lane];
#else
  if (present)
    for (uint c = 0; c < COLUMNS; ++c) y[(first_column + c) * y_stride + first_row + row] = sum[c];
#endif
}
