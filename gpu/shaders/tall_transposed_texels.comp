// What tall_transposed.comp computes, on drivers that compute on the CPU (dense_texels.comp says why), with SHARE columns
// of M for each invocation: nothing meets in shared memory.
#include "groups.glsl"

layout(local_size_x = 8) in;

layout(binding = 0) uniform samplerBuffer panels;  // fours
layout(binding = 1) uniform samplerBuffer x;       // fours
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
    for (uint e = 0; e < 16; ++e) {
      vec4 part[COLUMNS];
      for (uint c = 0; c < COLUMNS; ++c)
        part[c] = texelFetch(x, int(((first_column + c) * x_stride + (first_panel + panel) * 64) / 4 + e));
      for (uint s = 0; s < SHARE; ++s) {
        uint p = min(first + 8 * s, rank - 1);
        vec4 four = texelFetch(panels, int((panel * rank + p) * 16 + e));
        for (uint c = 0; c < COLUMNS; ++c) sum[s * COLUMNS + c] += dot(four, part[c]);
      }
    }
  for (uint s = 0; s < SHARE; ++s)
    for (uint c = 0; c < COLUMNS; ++c)
      if (first + 8 * s < rank)
        chunk_sums[((first_chunk + chunk) * columns + first_column + c) * sum_stride + first + 8 * s] =
            sum[s * COLUMNS + c];
}
