// Y = M X for COLUMNS columns and a matrix in tiles of 16 x 16 BC4 blocks of 4 x 4 texels, which are decoded here. LANES
// of the INVOCATIONS of a work group walk along a row of blocks side by side.
#include "groups.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(std430, binding = 0) readonly buffer Blocks { uvec2 blocks[]; };  // two bytes, then three bits a texel
layout(std430, binding = 1) readonly buffer X { vec4 x[]; };             // by columns, each of 16 tile_columns
layout(std430, binding = 2) writeonly buffer Y { float y[]; };

uniform uint tile_columns;
uniform uint first_row;  // of the matrix in this part
uniform uint part_block_rows;
uniform uint y_stride;
uniform uint first_column;
uniform uint column_step;
uniform uint scale_bits;  // floats, as their bits
uniform uint base_bits;   // of the curve (kernels/tile_format.hpp)
uniform uint slope_bits;

#if LANES > 1
shared vec4 sums[COLUMNS][INVOCATIONS];
#endif

const float seventh = 1.0 / 7.0;
const float fifth = 1.0 / 5.0;

#if LOGARITHMIC
// The bits of the number that a code stands for. A fused operation would change it in the fifth digit: base is
// near 2^30.
int bits(float code) {
  precise float scaled = code * uintBitsToFloat(slope_bits);
  precise float sum = scaled + uintBitsToFloat(base_bits);
  return int(sum);
}

// The eight numbers of a block, by index (kernels/tile_format.hpp, bc4_numbers).
void palette(uint word, out vec4 low, out vec4 high) {
  vec2 ends = vec2(word & 0xffu, (word >> 8) & 0xffu);
  bool eight = ends.x > ends.y;
  int A = bits(ends.x);
  int B = bits(ends.y);
  precise float part = float(B - A) * (eight ? seventh : fifth);
  int step = int(part);
  int some = ends.x > 0 || ends.y > 0 ? -1 : 0;
  low = vec4(ends.x > 0 ? intBitsToFloat(A) : 0, ends.y > 0 ? intBitsToFloat(B) : 0,
             intBitsToFloat((A + step) & some), intBitsToFloat((A + 2 * step) & some));
  high = vec4(intBitsToFloat((A + 3 * step) & some), intBitsToFloat((A + 4 * step) & some),
              eight ? intBitsToFloat(A + 5 * step) : 0, intBitsToFloat(eight ? A + 6 * step : bits(255)));
}
#else
void palette(uint word, out vec4 low, out vec4 high) {
  vec2 ends = vec2(word & 0xffu, (word >> 8) & 0xffu);
  bool eight = ends.x > ends.y;
  float slope = uintBitsToFloat(slope_bits);
  precise float A = ends.x * slope;
  precise float B = ends.y * slope;
  precise float step = (B - A) * (eight ? seventh : fifth);
  low = vec4(A, B, A + step, A + 2 * step);
  high = vec4(A + 3 * step, A + 4 * step, eight ? A + 5 * step : 0, eight ? A + 6 * step : 255 * slope);
}
#endif

vec4 chosen(vec4 four, bvec4 first_bit, bvec4 second_bit) {
  return mix(mix(four.xxxx, four.yyyy, first_bit), mix(four.zzzz, four.wwww, first_bit), second_bit);
}

// The indices of the four texels of a row, three bits each.
uint row_indices(uvec2 block, uint row) {
  if (row == 0) return block.x >> 16;
  if (row == 1) return block.x >> 28 | block.y << 4;
  return block.y >> (row == 2 ? 8 : 20);
}

void write_sum(uint c, uint row, float sum) {
  y[(first_column + c * column_step) * y_stride + row] = uintBitsToFloat(scale_bits) * sum;
}

void main() {
  uint lane = gl_LocalInvocationID.x % LANES;
  uint block_row = group_index() * (INVOCATIONS / LANES) + gl_LocalInvocationID.x / LANES;
  bool present = block_row < part_block_rows;
  uint row = first_row + block_row * 4;
  vec4 sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = vec4(0);
  uint block_columns = tile_columns * 16;
  uint end = present ? block_columns : 0;
  for (uint b = lane; b < end; b += LANES) {
    uvec2 block = blocks[((block_row / 16 * tile_columns + b / 16) * 16 + block_row % 16) * 16 + b % 16];
    vec4 low;
    vec4 high;
    palette(block.x, low, high);
    vec4 part[COLUMNS];
    for (uint c = 0; c < COLUMNS; ++c) part[c] = x[(first_column + c * column_step) * block_columns + b];
    for (uint r = 0; r < 4; ++r) {
      uvec4 index = uvec4(row_indices(block, r)) >> uvec4(0, 3, 6, 9);
      bvec4 first_bit = notEqual(index & 1u, uvec4(0));
      bvec4 second_bit = notEqual(index & 2u, uvec4(0));
      bvec4 third_bit = notEqual(index & 4u, uvec4(0));
      vec4 numbers = mix(chosen(low, first_bit, second_bit), chosen(high, first_bit, second_bit), third_bit);
      for (uint c = 0; c < COLUMNS; ++c) sum[c][r] += dot(numbers, part[c]);
    }
  }
#if LANES > 1
  for (uint c = 0; c < COLUMNS; ++c) sums[c][gl_LocalInvocationID.x] = sum[c];
  for (uint width = LANES / 2; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < COLUMNS; ++c) sums[c][gl_LocalInvocationID.x] += sums[c][gl_LocalInvocationID.x + width];
  }
  barrier();
  if (present && lane < 4 * COLUMNS)
    write_sum(lane / 4, row + lane % 4, sums[lane / 4][gl_LocalInvocationID.x - lane][lane % 4]);
#else
  if (present)
    for (uint c = 0; c < COLUMNS; ++c)
      for (uint r = 0; r < 4; ++r) write_sum(c, row + r, sum[c][r]);
#endif
}
