// Y = M X for COLUMNS columns. A work group has ROWS rows: its invocations walk along them side by side, so that
// memory is read in whole lines and each four of X serves all rows. Their sums meet in shared memory in two steps:
// eight invocations to a sum, then one.
#include "groups.glsl"
#include "dense_entries.glsl"

layout(local_size_x = INVOCATIONS) in;

const uint SUMS = ROWS * COLUMNS;
const uint TO_A_SUM = 8;
// Eight numbers more than there are invocations put those that are read together into different banks.
shared float all_sums[SUMS][INVOCATIONS + 8];
shared float few_sums[SUMS][TO_A_SUM];

void main() {
  uint row = group_index() * ROWS;
  if (row >= block_rows) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  float sum[SUMS];
  for (uint s = 0; s < SUMS; ++s) sum[s] = 0;
  for (uint quad = lane; quad < row_quads; quad += INVOCATIONS) {
    vec4 part[COLUMNS];
    for (uint c = 0; c < COLUMNS; ++c) part[c] = x[(first_column + c) * row_quads + quad];
    for (uint r = 0; r < ROWS; ++r) {
      vec4 four = four_entries((row + r) * row_quads + quad);
      for (uint c = 0; c < COLUMNS; ++c) sum[r * COLUMNS + c] += dot(four, part[c]);
    }
  }
  for (uint s = 0; s < SUMS; ++s) all_sums[s][lane] = sum[s];
  barrier();
  if (lane < SUMS * TO_A_SUM) {
    uint s = lane / TO_A_SUM;
    float few = 0;
    for (uint i = lane % TO_A_SUM; i < INVOCATIONS; i += TO_A_SUM) few += all_sums[s][i];
    few_sums[s][lane % TO_A_SUM] = few;
  }
  barrier();
  if (lane < SUMS) {
    float whole = 0;
    for (uint i = 0; i < TO_A_SUM; ++i) whole += few_sums[lane][i];
    y[(first_column + lane % COLUMNS) * y_stride + first_row + row + lane / COLUMNS] = whole;
  }
}
