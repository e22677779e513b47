// Y = M X for COLUMNS columns, on drivers that compute on the CPU: those read storage blocks number by number and lane by
// lane, but fetch texels as vectors. A work group is one vector of eight lanes, which walk along eight rows side by side,
// so that each four of X serves all rows.
#include "groups.glsl"

layout(local_size_x = 8) in;

#if EIGHT
layout(binding = 0) uniform usamplerBuffer entries; // by rows, eights of binary16 without subnormal numbers
#else
layout(binding = 0) uniform samplerBuffer entries;  // by rows, fours of float32
#endif
layout(binding = 1) uniform samplerBuffer x;        // by columns, each of row_quads
layout(std430, binding = 2) writeonly buffer Y { float y[]; };  // by columns, each of y_stride

uniform uint row_quads;     // fours of entries in a row
uniform uint first_row;     // of the matrix in this buffer
uniform uint block_rows;    // a multiple of 64
uniform uint y_stride;
uniform uint first_column;  // of X and Y, of COLUMNS

shared float lane_sums[8 * COLUMNS][8];

vec4 four_of_x(uint column, uint quad) {
  return texelFetch(x, int((first_column + column) * row_quads + quad));
}

#if EIGHT
// Bits of binary16 in the places of float32's are the number times 2^-112, which X and the sums make up for: fewer steps
// than a conversion. Those of even places are together, and those of odd.
const float of_x = exp2(96), of_sums = exp2(16);
const uint FOURS = 2;  // in a texel

vec4[FOURS] part_of_x(uint column, uint texel) {
  vec4 low = four_of_x(column, 2 * texel);
  vec4 high = four_of_x(column, 2 * texel + 1);
  return vec4[FOURS](of_x * vec4(low.xz, high.xz), of_x * vec4(low.yw, high.yw));
}

vec4[FOURS] entries_at(uint texel) {
  const int places = int(0x8fffe000u);
  ivec4 pairs = ivec4(texelFetch(entries, int(texel)));
  return vec4[FOURS](intBitsToFloat(pairs << 16 >> 3 & places), intBitsToFloat(pairs >> 3 & places));
}
#else
const float of_sums = 1;
const uint FOURS = 1;

vec4[FOURS] part_of_x(uint column, uint texel) {
  return vec4[FOURS](four_of_x(column, texel));
}

vec4[FOURS] entries_at(uint texel) {
  return vec4[FOURS](texelFetch(entries, int(texel)));
}
#endif

float product(vec4 a[FOURS], vec4 b[FOURS]) {
  float sum = dot(a[0], b[0]);
  for (uint f = 1; f < FOURS; ++f) sum += dot(a[f], b[f]);
  return sum;
}

void main() {
  uint row = group_index() * 8;
  if (row >= block_rows) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  float sum[8 * COLUMNS];
  for (uint s = 0; s < 8 * COLUMNS; ++s) sum[s] = 0;
  uint row_texels = row_quads / FOURS;
  for (uint texel = lane; texel < row_texels; texel += 8) {
    vec4 part[COLUMNS][FOURS];
    for (uint c = 0; c < COLUMNS; ++c) part[c] = part_of_x(c, texel);
    uint place = row * row_texels + texel;
    for (uint r = 0; r < 8; ++r, place += row_texels) {
      vec4 some[FOURS] = entries_at(place);
      for (uint c = 0; c < COLUMNS; ++c) sum[r * COLUMNS + c] += product(some, part[c]);
    }
  }
  for (uint s = 0; s < 8 * COLUMNS; ++s) lane_sums[s][lane] = sum[s];
  barrier();
  for (uint c = 0; c < COLUMNS; ++c) {
    float whole = 0;
    for (uint i = 0; i < 8; ++i) whole += lane_sums[lane * COLUMNS + c][i];
    y[(first_column + c) * y_stride + first_row + row + lane] = of_sums * whole;
  }
}
