// Y = M X for COLUMNS columns, SHARE rows for each invocation. Of binary16 four numbers are in a double.
#include "groups.glsl"
#include "wide_loads.glsl"

layout(local_size_x = INVOCATIONS) in;

const uint ROWS = INVOCATIONS * SHARE;

layout(std430, binding = 0) readonly buffer Entries { dvec4 entries[]; };  // by rows
layout(std430, binding = 1) readonly buffer X { dvec4 x[]; };              // by columns, each of 2 row_quads floats
layout(std430, binding = 2) writeonly buffer Y { float y[]; };             // by columns, each of y_stride

uniform uint row_quads;     // fours of entries in a row
uniform uint first_row;     // of the matrix in this block of storage
uniform uint block_rows;    // a multiple of 64
uniform uint y_stride;
uniform uint first_column;  // of X and Y, of COLUMNS

vec4 four_halves(double bits) {
  uvec2 pair = unpackDouble2x32(bits);
  return vec4(unpackHalf2x16(pair.x), unpackHalf2x16(pair.y));
}

#if HALF
const uint FOURS = 4;  // in a load
#else
const uint FOURS = 2;
#endif

void main() {
  uint row = group_index() * ROWS + gl_LocalInvocationID.x;
  if (group_index() * ROWS >= block_rows) return;
  uint loads = row_quads / FOURS;
  float sum[SHARE * COLUMNS];
  for (uint s = 0; s < SHARE * COLUMNS; ++s) sum[s] = 0;
  for (uint i = 0; i < loads; ++i) {
    vec4 part[COLUMNS * FOURS];
    for (uint c = 0; c < COLUMNS; ++c)
      for (uint f = 0; f < FOURS; f += 2) {
        dvec4 bits = x[((first_column + c) * row_quads + i * FOURS + f) / 2];
        part[c * FOURS + f] = four_floats(bits.xy);
        part[c * FOURS + f + 1] = four_floats(bits.zw);
      }
    for (uint r = 0; r < SHARE; ++r) {
      dvec4 bits = entries[(row + r * INVOCATIONS) * loads + i];
      vec4 four[FOURS];
#if HALF
      for (uint f = 0; f < FOURS; ++f) four[f] = four_halves(bits[f]);
#else
      four[0] = four_floats(bits.xy);
      four[1] = four_floats(bits.zw);
#endif
      for (uint c = 0; c < COLUMNS; ++c)
        for (uint f = 0; f < FOURS; ++f) sum[r * COLUMNS + c] += dot(four[f], part[c * FOURS + f]);
    }
  }
  for (uint r = 0; r < SHARE; ++r)
    for (uint c = 0; c < COLUMNS; ++c)
      y[(first_column + c) * y_stride + first_row + row + r * INVOCATIONS] = sum[r * COLUMNS + c];
}
