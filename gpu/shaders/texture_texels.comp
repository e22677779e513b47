// What texture_product.comp computes, on drivers that compute on the CPU (dense_texels.comp says why). Eight lanes walk
// along ROWS rows of blocks, four or eight, side by side, two blocks at a time.
#include "groups.glsl"

layout(local_size_x = 8) in;

layout(binding = 0) uniform usamplerBuffer blocks;  // by rows, twos: colours and indices of each
layout(binding = 1) uniform samplerBuffer x;        // by columns, each of block_columns
layout(binding = 2) uniform samplerBuffer palettes; // where LOGARITHMIC: for all pairs of codes of a colour channel
layout(std430, binding = 2) writeonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Tables { float tables[]; };  // 64 numbers a colour channel, then scales

uniform uint block_columns;
uniform uint first_block_row;  // of the matrix in this part
uniform uint part_block_rows;
uniform uint y_stride;
uniform uint first_column;     // of a light, of CHANNELS columns

shared float lane_sums[ROWS * CHANNELS * 4][8];

vec4 part[2 * CHANNELS];  // of X, for the two blocks
vec4 sum[ROWS * CHANNELS];
#if !LOGARITHMIC
vec2 part_sum[CHANNELS];
float lowest[ROWS * CHANNELS];
#endif

void read_part(uint pair) {
  for (uint c = 0; c < CHANNELS; ++c)
    for (uint side = 0; side < 2; ++side) {
      vec4 four = texelFetch(x, int((first_column + c) * block_columns + 2 * pair + side));
#if LOGARITHMIC
      part[2 * c + side] = four;
#else
      part[2 * c + side] = four * vec4(1, 1.0 / 4, 1.0 / 16, 1.0 / 64);
      part_sum[c][side] = four.x + four.y + (four.z + four.w);
#endif
    }
}

uint colour_of(uint channel) {
  return CHANNELS == 1 ? 1 : channel;
}

uvec2 codes(uint colours, uint colour) {
  int bits = colour == 1 ? 6 : 5;
  int shift = colour == 0 ? 11 : colour == 1 ? 5 : 0;
  return uvec2(bitfieldExtract(colours, shift, bits), bitfieldExtract(colours, shift + 16, bits));
}

#if LOGARITHMIC
vec4 palette(uint colours, uint colour) {
  uvec2 pair = codes(colours, colour);
  uint first_palette = CHANNELS == 1 || colour == 0 ? 0 : colour == 1 ? 32 * 32 : 32 * 32 + 64 * 64;
  return texelFetch(palettes, int(first_palette + pair.y * (colour == 1 ? 64 : 32) + pair.x));
}

vec4 palettes_ahead[CHANNELS];  // of the block that is added next

void read_palettes(uint colours) {
  for (uint c = 0; c < CHANNELS; ++c) palettes_ahead[c] = palette(colours, colour_of(c));
}

// What is asked of a texel's index serves all channels at once.
void add_block(uint row, uint side, uint colours, uint indices, uint colours_ahead) {
  vec4 number[CHANNELS] = palettes_ahead;
  read_palettes(colours_ahead);
  for (uint r = 0; r < 4; ++r) {
    float texels[CHANNELS];
    for (uint c = 0; c < CHANNELS; ++c) texels[c] = 0;
    for (uint column = 0; column < 4; ++column) {
      bool low = (indices & 1u << (8 * r + 2 * column)) != 0;
      bool high = (indices & 2u << (8 * r + 2 * column)) != 0;
      for (uint c = 0; c < CHANNELS; ++c) {
        float below = low ? number[c].y : number[c].x;
        float above = low ? number[c].w : number[c].z;
        texels[c] += part[2 * c + side][column] * (high ? above : below);
      }
    }
    for (uint c = 0; c < CHANNELS; ++c) sum[row * CHANNELS + c][r] += texels[c];
  }
}
#else

// Steps lead up from the lower of the two colours, so that a texel of 0 adds exactly 0. How many thirds of a step each
// texel is up, 0 to 3, is a number of two bits in the place of its index: sums need no selection.
void add_block(uint row, uint side, uint colours, uint indices, uint colours_ahead) {
  const uint lower_bits = 0x55555555u;
  for (uint c = 0; c < CHANNELS; ++c) {
    ivec2 pair = ivec2(codes(colours, colour_of(c)));
    uint upward = pair.x > pair.y ? indices ^ lower_bits : indices;
    uint low = upward & lower_bits;
    uint thirds = low << 1 | (upward >> 1 & lower_bits ^ low);
    float step = float(abs(pair.y - pair.x));
    lowest[row * CHANNELS + c] += float(min(pair.x, pair.y)) * part_sum[c][side];
    for (uint r = 0; r < 4; ++r) {
      ivec4 shifted = ivec4(uvec4(thirds >> 8 * r) & uvec4(3, 3 << 2, 3 << 4, 3 << 6));
      sum[row * CHANNELS + c][r] += step * dot(part[2 * c + side], vec4(shifted));
    }
  }
}

#endif

// A fetch takes longer than the sums of a row: blocks are fetched two rows before they are added, palettes one block.
uvec4 two = uvec4(0);        // blocks of the row that is added next
uvec4 two_ahead = uvec4(0);  // of the one after

// Of one of the rows, or of the first ones at the next pair, if there is one.
uvec4 two_blocks(uint row, uint pair) {
  uint block_row = min(group_index() * ROWS + row % ROWS, part_block_rows - 1);
  uint pairs = block_columns / 2;
  return texelFetch(blocks, int(block_row * pairs + (row < ROWS ? pair : min(pair + 8, pairs - 1))));
}

void add_blocks(uint row, uint pair) {
  uvec4 later = two_blocks(row + 2, pair);
  add_block(row, 0, two.x, two.y, two.z);
  add_block(row, 1, two.z, two.w, two_ahead.x);
  two = two_ahead;
  two_ahead = later;
}

void main() {
  if (group_index() * ROWS >= part_block_rows) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  for (uint s = 0; s < ROWS * CHANNELS; ++s) {
    sum[s] = vec4(0);
#if !LOGARITHMIC
    lowest[s] = 0;
#endif
  }
  two = two_blocks(0, lane);
  two_ahead = two_blocks(1, lane);
#if LOGARITHMIC
  read_palettes(two.x);
#endif
  for (uint pair = lane; pair < block_columns / 2; pair += 8) {
    read_part(pair);
    add_blocks(0, pair);  // not in a loop, which drivers would not unroll: sums were in memory then
    add_blocks(1, pair);
    add_blocks(2, pair);
    add_blocks(3, pair);
#if ROWS == 8
    add_blocks(4, pair);
    add_blocks(5, pair);
    add_blocks(6, pair);
    add_blocks(7, pair);
#endif
  }
  for (uint s = 0; s < ROWS * CHANNELS; ++s) {
#if !LOGARITHMIC
    sum[s] = (sum[s] + 3 * lowest[s]) / (colour_of(s % CHANNELS) == 1 ? 3 * 63 : 3 * 31);
#endif
    for (uint r = 0; r < 4; ++r) lane_sums[4 * s + r][lane] = sum[s][r];
  }
  barrier();
  for (uint s = lane; s < ROWS * CHANNELS * 4; s += 8) {
    uint channel = s / 4 % CHANNELS;
    uint block_row = group_index() * ROWS + s / (4 * CHANNELS);
    float whole = 0;
    for (uint i = 0; i < 8; ++i) whole += lane_sums[s][i];
    if (block_row < part_block_rows)
      y[(first_column + channel) * y_stride + (first_block_row + block_row) * 4 + s % 4] =
          tables[3 * 64 + channel] * whole;
  }
}
