// From the sums of all work groups, or numbers, of a column (fields.glsl) to the scalars that the next step of a solver takes, in a
// work group a column. A column that is solved, or that rounding has made worthless, stays as it is: 0 / 0 is 0 here.
#include "groups.glsl"

#define NEUMANN 0      // the only sum is (W change)^2
#define STEP_LENGTH 1  // the only sum is p q
#define CONJUGATION 2  // the sums are r^2 and (W r)^2

layout(local_size_x = 64) in;

layout(std430, binding = 1) buffer Scalars { vec4 scalars[]; };  // r^2, alpha, beta, (W r)^2 of a column
layout(std430, binding = 7) readonly buffer Sums { float group_sums[]; };

uniform uint groups_of_column;  // or numbers
uniform uint columns;
uniform uint starting;

shared float lane_sums[SUMS][64];

float quotient(float above, float below) {
  return below > 0 ? above / below : 0;
}

void main() {
  uint column = group_index();
  if (column >= columns) return;  // the whole group
  uint lane = gl_LocalInvocationID.x;
  for (uint s = 0; s < SUMS; ++s) {
    float sum = 0;
    for (uint group = lane; group < groups_of_column; group += 64)
      sum += group_sums[(column * groups_of_column + group) * SUMS + s];
    lane_sums[s][lane] = sum;
  }
  for (uint width = 32; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint s = 0; s < SUMS; ++s) lane_sums[s][lane] += lane_sums[s][lane + width];
  }
  barrier();
  if (lane > 0) return;
  vec4 own = scalars[column];
#if STAGE == NEUMANN
  own.w = lane_sums[0][0];
#elif STAGE == STEP_LENGTH
  // The right-hand side arrives as the image of the direction 0.
  own.y = starting == 1 ? 1 : quotient(own.x, lane_sums[0][0]);
#else
  own.z = starting == 1 ? 0 : quotient(lane_sums[0][0], own.x);
  own.x = lane_sums[0][0];
  own.w = lane_sums[1][0];
#endif
  scalars[column] = own;
}
