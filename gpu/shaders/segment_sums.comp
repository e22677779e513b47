// C = V' X for COLUMNS columns, where V has one number a row (document 004, Eq. 7): a work group adds up one segment of
// the rows sorted by patch.
#include "groups.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 1) readonly buffer X { float x[]; };
#if WEIGHTED
layout(std430, binding = 3) readonly buffer Weights { float weights[]; };  // by sorted position
#endif
layout(std430, binding = 4) writeonly buffer Coefficients { float coefficients[]; };
#if ORDERED
layout(std430, binding = 5) readonly buffer Order { uint order[]; };  // the row at each sorted position
#endif

uniform uint segments;
uniform uint x_stride;    // between columns
uniform uint sum_stride;  // between columns of coefficients
uniform uint first_column;

shared float sums[COLUMNS][64];

void main() {
  uint segment = group_index();
  if (segment >= segments) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  float sum[COLUMNS];
  for (uint c = 0; c < COLUMNS; ++c) sum[c] = 0;
  for (uint i = offsets[segment] + lane; i < offsets[segment + 1]; i += 64) {
#if ORDERED
    uint row = order[i];
#else
    uint row = i;
#endif
#if WEIGHTED
    float weight = weights[i];
#else
    const float weight = 1;
#endif
    for (uint c = 0; c < COLUMNS; ++c) sum[c] += weight * x[(first_column + c) * x_stride + row];
  }
  for (uint c = 0; c < COLUMNS; ++c) sums[c][lane] = sum[c];
  for (uint width = 32; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < COLUMNS; ++c) sums[c][lane] += sums[c][lane + width];
  }
  barrier();
  if (lane < COLUMNS) coefficients[(first_column + lane) * sum_stride + segment] = sums[lane][0];
}
