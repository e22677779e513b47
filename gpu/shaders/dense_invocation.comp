// Y = M X for COLUMNS columns, a row for each invocation.
#include "groups.glsl"
#include "dense_entries.glsl"

layout(local_size_x = ROWS) in;

void main() {
  uint row = group_index() * ROWS + gl_LocalInvocationID.x;
  if (row >= block_rows) return;
  float sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = 0;
  for (uint quad = 0; quad < row_quads; ++quad) {
    vec4 four = four_entries(row * row_quads + quad);
    for (uint c = 0; c < COLUMNS; ++c) sum[c] += dot(four, x[(first_column + c) * row_quads + quad]);
  }
  for (uint c = 0; c < COLUMNS; ++c) y[(first_column + c) * y_stride + first_row + row] = sum[c];
}
