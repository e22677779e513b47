// Y = M X for one matrix a channel in textures of BC1 blocks, whose codes the device's texture units decode. LANES of the
// INVOCATIONS of a work group walk along a row of blocks of 4 x 4 texels side by side.
#include "groups.glsl"

layout(local_size_x = INVOCATIONS) in;

layout(binding = 0) uniform sampler2D texels;
layout(std430, binding = 1) readonly buffer X { vec4 x[]; };  // by columns, each of block_columns
layout(std430, binding = 2) writeonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Curve { float range, scales[3]; };

uniform uint block_columns;
uniform uint blocks_across;    // of the texture: a longer row goes on in its next one
uniform uint first_block_row;  // of the matrix in this part
uniform uint part_block_rows;
uniform uint y_stride;
uniform uint first_column;     // of a light, of CHANNELS columns

#define SUMS CHANNELS
#include "four_row_sums.glsl"

void write_sum(uint channel, uint row, float sum) {
  y[(first_column + channel) * y_stride + row] = scales[channel] * sum;
}

// What the codes of the channels stand for: kernels/colour_texture.hpp.
vec3 numbers_of(vec3 codes) {
#if LOGARITHMIC
  return mix(exp(range * (codes - 1)), vec3(0), equal(codes, vec3(0)));
#else
  return codes;
#endif
}

// Where block b of a row is in the texture.
ivec2 corner_of(uint block_row, uint b) {
  uint texture_rows = (block_columns + blocks_across - 1) / blocks_across;
  return 4 * ivec2(b % blocks_across, block_row * texture_rows + b / blocks_across);
}

void main() {
  uint lane = gl_LocalInvocationID.x % LANES;
  uint block_row = group_index() * (INVOCATIONS / LANES) + gl_LocalInvocationID.x / LANES;
  bool present = block_row < part_block_rows;
  vec4 sum[CHANNELS];
  for (uint c = 0; c < CHANNELS; ++c) sum[c] = vec4(0);
  uint end = present ? block_columns : 0;
  for (uint b = lane; b < end; b += LANES) {
    ivec2 corner = corner_of(block_row, b);
    vec4 part[CHANNELS];
    for (uint c = 0; c < CHANNELS; ++c) part[c] = x[(first_column + c) * block_columns + b];
    for (int r = 0; r < 4; ++r)
      for (int i = 0; i < 4; ++i) {
        vec3 numbers = numbers_of(texelFetch(texels, corner + ivec2(i, r), 0).rgb);
        for (uint c = 0; c < CHANNELS; ++c) sum[c][r] += numbers[CHANNELS == 1 ? 1 : c] * part[c][i];
      }
  }
  write_four_rows(sum, present, (first_block_row + block_row) * 4);
}
