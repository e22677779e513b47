// What csr_rows.comp computes, on drivers that compute on the CPU (dense_texels.comp says why). Each lane has a row, or
// TOGETHER of them, of which it reads four entries at a time: those of its neighbours too where the row does not begin
// or end with a four.
#include "groups.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(binding = 0) uniform samplerBuffer values;    // fours: of entries, or of the rows of one
layout(binding = 1) uniform samplerBuffer x;         // by columns, single numbers
layout(binding = 2) uniform usamplerBuffer columns;  // fours
layout(std430, binding = 4) readonly buffer RowBegin { uint row_begin[]; };
layout(std430, binding = 2) buffer Y { float y[]; };

uniform uint first_row;   // of the matrix in this block of storage, in TOGETHER of them as the next
uniform uint block_rows;
uniform uint x_stride;    // between columns
uniform uint y_stride;
uniform uint first_column;
uniform uint column_step;

#if TOGETHER == 1
#define SUM float
#else
#define SUM vec4
#endif

void write_sum(uint place, float sum) {
#if ADDS
  sum += y[place];
#endif
  y[place] = sum;
}

void main() {
  uint row = group_index() * INVOCATIONS + gl_LocalInvocationID.x;
  bool present = row < block_rows;
  uint begin = present ? row_begin[row] : 0;
  uint end = present ? row_begin[row + 1] : 0;
  SUM sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = SUM(0);
  for (uint four = begin / 4; 4 * four < end; ++four) {
    uvec4 place = 4 * four - begin + uvec4(0, 1, 2, 3);  // in the row; before it, beyond all numbers
    bvec4 of_row = lessThan(place, uvec4(end - begin));
#if TOGETHER == 1
    vec4 value = texelFetch(values, int(four));
#else
    vec4 value[4];
    for (uint i = 0; i < 4; ++i) value[i] = texelFetch(values, int(4 * four + i));
#endif
    ivec4 column = ivec4(texelFetch(columns, int(four)));
    for (uint c = 0; c < COLUMNS; ++c) {
      ivec4 at = column + int((first_column + c * column_step) * x_stride);
      vec4 part = vec4(texelFetch(x, at.x).x, texelFetch(x, at.y).x, texelFetch(x, at.z).x, texelFetch(x, at.w).x);
      part = mix(vec4(0), part, of_row);
#if TOGETHER == 1
      sum[c] += dot(value, part);
#else
      sum[c] += (value[0] * part.x + value[1] * part.y) + (value[2] * part.z + value[3] * part.w);
#endif
    }
  }
  if (!present) return;
  for (uint c = 0; c < COLUMNS; ++c) {
    uint at = (first_column + c * column_step) * y_stride + (first_row + row) * TOGETHER;
#if TOGETHER == 1
    write_sum(at, sum[c]);
#else
    for (uint r = 0; r < TOGETHER; ++r) write_sum(at + r, sum[c][r]);
#endif
  }
}
