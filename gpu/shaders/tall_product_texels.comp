// What tall_product.comp computes, on drivers that compute on the CPU (dense_texels.comp says why): eight lanes share a
// panel, each with two fours of its rows.
#include "groups.glsl"

layout(local_size_x = 8) in;

layout(binding = 0) uniform samplerBuffer panels;        // fours
layout(binding = 1) uniform samplerBuffer coefficients;  // fours
layout(std430, binding = 2) writeonly buffer Y { float y[]; };
#if ORDERED
layout(std430, binding = 5) readonly buffer Order { uint order[]; };  // where each row goes
#endif

uniform uint rank;
uniform uint rows;
uniform uint first_panel;  // in this block of storage
uniform uint block_panels;
uniform uint x_stride;     // between columns of coefficients
uniform uint y_stride;
uniform uint first_column;

void main() {
  uint panel = group_index();
  if (panel >= block_panels) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  vec4 low[COLUMNS];
  vec4 high[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) low[c] = high[c] = vec4(0);
  uint entry = panel * rank * 16 + lane;
  for (uint first = 0; first < rank; first += 4) {
    vec4 four[COLUMNS];
    for (uint c = 0; c < COLUMNS; ++c)
      four[c] = texelFetch(coefficients, int(((first_column + c) * x_stride + first) / 4));
    uint present = min(rank - first, 4);
    for (uint p = 0; p < 4; ++p) {
      if (p >= present) break;
      vec4 first_rows = texelFetch(panels, int(entry));
      vec4 last_rows = texelFetch(panels, int(entry + 8));
      entry += 16;
      for (uint c = 0; c < COLUMNS; ++c) {
        low[c] += four[c][p] * first_rows;
        high[c] += four[c][p] * last_rows;
      }
    }
  }
  for (uint r = 0; r < 8; ++r) {
    uint row = (first_panel + panel) * 64 + r / 4 * 32 + lane * 4 + r % 4;
    if (row >= rows) return;  // as those after it
#if ORDERED
    row = order[row];
#endif
    for (uint c = 0; c < COLUMNS; ++c)
      y[(first_column + c) * y_stride + row] = r < 4 ? low[c][r] : high[c][r - 4];
  }
}
