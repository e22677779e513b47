// Y = M C for COLUMNS columns and a tall M of `rank` columns in panels of 64 rows, which are stored by columns: the 64
// rows of a work group are side by side in memory, and all of them need the same coefficient at a time. DOUBLE: in that
// precision.
#include "groups.glsl"
#include "number.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Panels { NUMBER panels[]; };
layout(std430, binding = 1) readonly buffer Coefficients { NUMBER coefficients[]; };
layout(std430, binding = 2) writeonly buffer Y { NUMBER y[]; };
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
  uint row = (first_panel + panel) * 64 + gl_LocalInvocationID.x;
  if (panel >= block_panels || row >= rows) return;
  NUMBER sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = 0;
  uint entry = panel * rank * 64 + gl_LocalInvocationID.x;
  for (uint p = 0; p < rank; ++p, entry += 64) {
    NUMBER value = panels[entry];
    for (uint c = 0; c < COLUMNS; ++c) sum[c] += value * coefficients[(first_column + c) * x_stride + p];
  }
#if ORDERED
  row = order[row];
#endif
  for (uint c = 0; c < COLUMNS; ++c) y[(first_column + c) * y_stride + row] = sum[c];
}
