// Coefficients from their sums over chunks, times a number each where SCALED. DOUBLE: in that precision.
#include "groups.glsl"
#include "number.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 3) readonly buffer Sums { NUMBER chunk_sums[]; };
layout(std430, binding = 4) writeonly buffer Coefficients { NUMBER coefficients[]; };
#if SCALED
layout(std430, binding = 5) readonly buffer Values { NUMBER values[]; };
#endif

uniform uint chunks;
uniform uint rank;
uniform uint columns;
uniform uint stride;  // between columns of both

void main() {
  uint index = group_index() * 64 + gl_LocalInvocationID.x;
  uint column = index / stride;
  uint p = index % stride;
  if (column >= columns || p >= rank) return;
  NUMBER sum = 0;
  for (uint chunk = 0; chunk < chunks; ++chunk) sum += chunk_sums[(chunk * columns + column) * stride + p];
#if SCALED
  sum *= values[p];
#endif
  coefficients[column * stride + p] = sum;
}
