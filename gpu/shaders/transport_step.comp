// What stands between two products: H from Y = M X (0 where FIRST), and the next X from B = E + R H.
#include "groups.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Diagonals { float diagonals[]; };  // before, after, R: 3 columns each
layout(std430, binding = 1) writeonly buffer X { float x[]; };
layout(std430, binding = 2) readonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Places { uint places[]; };  // of each patch in the rows of M
layout(std430, binding = 4) readonly buffer Emission { float emission[]; };
layout(std430, binding = 5) writeonly buffer Irradiance { float irradiance[]; };

uniform uint patches;
uniform uint stride;  // between columns
uniform uint slots;   // the column of X and Y of each colour, 2 bits each

void main() {
  uint patch_index = group_index() * 64 + gl_LocalInvocationID.x;
  if (patch_index >= patches) return;
  uint place = places[patch_index];
  for (uint colour = 0; colour < 3; ++colour) {
    uint here = colour * stride + patch_index;
    uint there = ((slots >> (2u * colour)) & 3u) * stride + place;
    float received = 0;
#if !FIRST
    received = diagonals[3 * stride + here] * y[there];
#endif
    irradiance[here] = received;
    x[there] = diagonals[here] * (emission[here] + diagonals[6 * stride + here] * received);
  }
}
