// What tall_transposed.comp computes, with SHARE columns of M for each invocation: nothing meets in shared memory.
#include "groups.glsl"
#include "wide_loads.glsl"

layout(local_size_x = 8) in;

layout(std430, binding = 0) readonly buffer Panels { dvec4 panels[]; };
layout(std430, binding = 1) readonly buffer X { dvec4 x[]; };
layout(std430, binding = 3) writeonly buffer Sums { float chunk_sums[]; };

uniform uint rank;
uniform uint first_panel;      // in this block of storage
uniform uint block_panels;
uniform uint panels_of_chunk;
uniform uint first_chunk;      // of this block
uniform uint columns;          // of X in all
uniform uint x_stride;
uniform uint sum_stride;       // between columns of sums
uniform uint first_column;

void main() {
  uint groups = (rank + 8 * SHARE - 1) / (8 * SHARE);  // of columns of M
  uint chunk = group_index() / groups;
  uint begin = chunk * panels_of_chunk;
  if (begin >= block_panels) return;  // the whole group
  uint end = min(begin + panels_of_chunk, block_panels);
  uint first = group_index() % groups * 8 * SHARE + gl_LocalInvocationID.x;
  float sum[SHARE * COLUMNS];
  for (uint s = 0; s < SHARE * COLUMNS; ++s) sum[s] = 0;
  for (uint panel = begin; panel < end; ++panel)
    for (uint e = 0; e < 8; ++e) {
      vec4 part[2 * COLUMNS];
      for (uint c = 0; c < COLUMNS; ++c) {
        dvec4 bits = x[((first_column + c) * x_stride + (first_panel + panel) * 64) / 8 + e];
        part[2 * c] = four_floats(bits.xy);
        part[2 * c + 1] = four_floats(bits.zw);
      }
      for (uint s = 0; s < SHARE; ++s) {
        uint p = min(first + 8 * s, rank - 1);
        dvec4 bits = panels[(panel * rank + p) * 8 + e];
        vec4 low = four_floats(bits.xy);
        vec4 high = four_floats(bits.zw);
        for (uint c = 0; c < COLUMNS; ++c)
          sum[s * COLUMNS + c] += dot(low, part[2 * c]) + dot(high, part[2 * c + 1]);
      }
    }
  for (uint s = 0; s < SHARE; ++s)
    for (uint c = 0; c < COLUMNS; ++c)
      if (first + 8 * s < rank)
        chunk_sums[((first_chunk + chunk) * columns + first_column + c) * sum_stride + first + 8 * s] =
            sum[s * COLUMNS + c];
}
