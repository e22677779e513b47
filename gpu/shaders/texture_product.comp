// Y = M X for one matrix a channel in BC1 blocks of 4 x 4 texels, which are decoded here: the indices of a block serve
// all channels. The INVOCATIONS of a work group walk along a row of blocks side by side.
#include "groups.glsl"

layout(local_size_x = INVOCATIONS) in;

// Blocks: two colours, then the indices. X: by columns, each of block_columns.
layout(std430, binding = 0) readonly buffer Blocks { uvec2 blocks[]; };
layout(std430, binding = 1) readonly buffer X { vec4 x[]; };
layout(std430, binding = 2) writeonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Tables { float tables[]; };  // 64 numbers a colour channel, then scales

uniform uint block_columns;
uniform uint first_block_row;  // of the matrix in this part
uniform uint part_block_rows;
uniform uint y_stride;
uniform uint first_column;     // of a light, of CHANNELS columns

#define SUMS CHANNELS
#define LANES INVOCATIONS
#include "four_row_sums.glsl"

void write_sum(uint channel, uint row, float sum) {
  y[(first_column + channel) * y_stride + row] = tables[3 * 64 + channel] * sum;
}

// The four numbers of a block in a channel, by index: what kernels/colour_texture.hpp says.
vec4 palette(uint colours, uint channel) {
  uint colour = CHANNELS == 1 ? 1 : channel;
  int bits = colour == 1 ? 6 : 5;
  int shift = colour == 0 ? 11 : colour == 1 ? 5 : 0;
  uint first = bitfieldExtract(colours, shift, bits);
  uint second = bitfieldExtract(colours, shift + 16, bits);
  float a = tables[colour * 64 + first];
  float b = tables[colour * 64 + second];
#if LOGARITHMIC
  bool none = first == 0 && second == 0;
  return vec4(first == 0 ? 0 : a * a * a, second == 0 ? 0 : b * b * b, none ? 0 : a * a * b, none ? 0 : a * (b * b));
#else
  const float third = 1.0 / 3.0;
  float a_third = a * third;
  float b_third = b * third;
  return vec4(a, b, a_third + a_third + b_third, a_third + (b_third + b_third));
#endif
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint block_row = group_index();
  if (block_row >= part_block_rows) return;  // the whole group
  uint first_row = (first_block_row + block_row) * 4;
  vec4 sum[CHANNELS];
  for (uint c = 0; c < CHANNELS; ++c) sum[c] = vec4(0);
  for (uint b = lane; b < block_columns; b += INVOCATIONS) {
    uvec2 block = blocks[block_row * block_columns + b];
    bvec4 low[4];
    bvec4 high[4];
    for (uint r = 0; r < 4; ++r) {
      uvec4 index = uvec4(block.y) >> (uvec4(0, 2, 4, 6) + 8 * r);
      low[r] = notEqual(index & 1u, uvec4(0));
      high[r] = notEqual(index & 2u, uvec4(0));
    }
    for (uint c = 0; c < CHANNELS; ++c) {
      vec4 number = palette(block.x, c);
      vec4 part = x[(first_column + c) * block_columns + b];
      for (uint r = 0; r < 4; ++r)
        sum[c][r] += dot(part, mix(mix(number.xxxx, number.yyyy, low[r]), mix(number.zzzz, number.wwww, low[r]), high[r]));
    }
  }
  write_four_rows(sum, true, first_row);
}
