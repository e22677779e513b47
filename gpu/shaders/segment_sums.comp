// C = V' X for COLUMNS columns, where V has one number a row (document 004, Eq. 7): LANES invocations, 64 or one, add up
// one segment of the rows sorted by patch. DOUBLE: in that precision.
#include "groups.glsl"
#include "number.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 1) readonly buffer X { NUMBER x[]; };
#if WEIGHTED
layout(std430, binding = 3) readonly buffer Weights { NUMBER weights[]; };  // by sorted position
#endif
layout(std430, binding = 4) writeonly buffer Coefficients { NUMBER coefficients[]; };
#if ORDERED
layout(std430, binding = 5) readonly buffer Order { uint order[]; };  // the row at each sorted position
#endif

uniform uint segments;
uniform uint x_stride;    // between columns
uniform uint sum_stride;  // between columns of coefficients
uniform uint first_column;

#if LANES > 1
shared NUMBER sums[COLUMNS][64];
#endif

void main() {
  uint segment = (group_index() * 64 + gl_LocalInvocationID.x) / LANES;
  if (segment >= segments) return;  // the whole group where lanes share it
  uint lane = gl_LocalInvocationID.x % LANES;
  NUMBER sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = 0;
  uint end = offsets[segment + 1];
  for (uint i = offsets[segment] + lane; i < end; i += LANES) {
#if ORDERED
    uint row = order[i];
#else
    uint row = i;
#endif
#if WEIGHTED
    NUMBER weight = weights[i];
#else
    const NUMBER weight = 1;
#endif
    for (uint c = 0; c < COLUMNS; ++c) sum[c] += weight * x[(first_column + c) * x_stride + row];
  }
#if LANES > 1
  for (uint c = 0; c < COLUMNS; ++c) sums[c][lane] = sum[c];
  for (uint width = 32; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < COLUMNS; ++c) sums[c][lane] += sums[c][lane + width];
  }
  barrier();
  if (lane < COLUMNS) coefficients[(first_column + lane) * sum_stride + segment] = sums[lane][0];
#else
  for (uint c = 0; c < COLUMNS; ++c) coefficients[(first_column + c) * sum_stride + segment] = sum[c];
#endif
}
