// Entries of a matrix by rows, four at a time, in float32 or (HALF) binary16.
#if HALF
layout(std430, binding = 0) readonly buffer Entries { uvec2 entries[]; };

vec4 four_entries(uint quad) {
  uvec2 bits = entries[quad];
  return vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y));
}
#else
layout(std430, binding = 0) readonly buffer Entries { vec4 entries[]; };

vec4 four_entries(uint quad) {
  return entries[quad];
}
#endif

layout(std430, binding = 1) readonly buffer X { vec4 x[]; };    // by columns, each of row_quads
layout(std430, binding = 2) writeonly buffer Y { float y[]; };  // by columns, each of y_stride

uniform uint row_quads;     // fours of entries in a row
uniform uint first_row;     // of the matrix in this block of storage
uniform uint block_rows;    // a multiple of 64
uniform uint y_stride;
uniform uint first_column;  // of X and Y, of COLUMNS
