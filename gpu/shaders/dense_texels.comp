// Y = M X for COLUMNS columns, on drivers that compute on the CPU: those read storage blocks number by number and lane by
// lane, but fetch texels as vectors. A work group is one vector of eight lanes, which walk along eight rows side by side,
// so that each four of X serves all rows.
#include "groups.glsl"

layout(local_size_x = 8) in;

layout(binding = 0) uniform samplerBuffer entries;  // by rows, fours of float32 or binary16
layout(binding = 1) uniform samplerBuffer x;        // by columns, each of row_quads
layout(std430, binding = 2) writeonly buffer Y { float y[]; };  // by columns, each of y_stride

uniform uint row_quads;     // fours of entries in a row
uniform uint first_row;     // of the matrix in this buffer
uniform uint block_rows;    // a multiple of 64
uniform uint y_stride;
uniform uint first_column;  // of X and Y, of COLUMNS

shared float lane_sums[8 * COLUMNS][8];

void main() {
  uint row = group_index() * 8;
  if (row >= block_rows) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  float sum[8 * COLUMNS];
  for (uint s = 0; s < 8 * COLUMNS; ++s) sum[s] = 0;
  for (uint quad = lane; quad < row_quads; quad += 8) {
    vec4 part[COLUMNS];
    for (uint c = 0; c < COLUMNS; ++c) part[c] = texelFetch(x, int((first_column + c) * row_quads + quad));
    uint entry = row * row_quads + quad;
    for (uint r = 0; r < 8; ++r, entry += row_quads) {
      vec4 four = texelFetch(entries, int(entry));
      for (uint c = 0; c < COLUMNS; ++c) sum[r * COLUMNS + c] += dot(four, part[c]);
    }
  }
  for (uint s = 0; s < 8 * COLUMNS; ++s) lane_sums[s][lane] = sum[s];
  barrier();
  for (uint c = 0; c < COLUMNS; ++c) {
    float whole = 0;
    for (uint i = 0; i < 8; ++i) whole += lane_sums[lane * COLUMNS + c][i];
    y[(first_column + c) * y_stride + first_row + row + lane] = whole;
  }
}
