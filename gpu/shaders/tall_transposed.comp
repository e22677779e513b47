// Sums of M' X over chunks of panels, for COLUMNS columns and a tall M in panels of 64 rows, which are stored by
// columns. A work group has one column of M and one chunk: its 64 invocations read a column of a panel side by side
// and meet in shared memory once, after all panels. DOUBLE: in that precision.
#include "groups.glsl"
#include "number.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Panels { NUMBER panels[]; };
layout(std430, binding = 1) readonly buffer X { NUMBER x[]; };
layout(std430, binding = 3) writeonly buffer Sums { NUMBER chunk_sums[]; };

uniform uint rank;
uniform uint first_panel;      // in this block of storage
uniform uint block_panels;
uniform uint panels_of_chunk;
uniform uint first_chunk;      // of this block
uniform uint columns;          // of X in all
uniform uint x_stride;
uniform uint sum_stride;       // between columns of sums
uniform uint first_column;

shared NUMBER sums[COLUMNS][64];

void main() {
  uint chunk = group_index() / rank;
  uint p = group_index() % rank;
  uint begin = chunk * panels_of_chunk;
  if (begin >= block_panels) return;  // the whole group
  uint end = min(begin + panels_of_chunk, block_panels);
  uint lane = gl_LocalInvocationID.x;
  NUMBER sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = 0;
  for (uint panel = begin; panel < end; ++panel) {
    NUMBER value = panels[(panel * rank + p) * 64 + lane];
    for (uint c = 0; c < COLUMNS; ++c)
      sum[c] += value * x[(first_column + c) * x_stride + (first_panel + panel) * 64 + lane];
  }
  for (uint c = 0; c < COLUMNS; ++c) sums[c][lane] = sum[c];
  for (uint width = 32; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < COLUMNS; ++c) sums[c][lane] += sums[c][lane + width];
  }
  barrier();
  if (lane < COLUMNS)
    chunk_sums[((first_chunk + chunk) * columns + first_column + lane) * sum_stride + p] = sums[lane][0];
}
