// E of each patch: its own, and what it reflects of the mean of POINTS points on it that the lights reach (document
// 000, section 3.6, step 2). LANES invocations share a patch.
#include "groups.glsl"
#include "frame_block.glsl"
#include "direct_light.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };  // position, normal
layout(std430, binding = 1) readonly buffer Reflectance { float reflectance[]; };
layout(std430, binding = 2) readonly buffer Own { float own[]; };
layout(std430, binding = 3) writeonly buffer Emission { float emission[]; };

uniform uint patches;
uniform uint stride;  // between columns
uniform uint points_of_patch;

#if LANES > 1
shared vec3 sums[64];
#endif

vec3 received_at(uint point) {
  vec3 position = points[2 * point].xyz;
  vec3 normal = points[2 * point + 1].xyz;
  vec3 sum = vec3(0);
  for (int k = 0; k < int(scalars.z); ++k) {
    vec3 light = unshadowed(lights[k], position, normal);
    if (light != vec3(0)) sum += light * lit_or_not(lights[k], position, normal);
  }
  return sum;
}

void main() {
  uint lane = gl_LocalInvocationID.x % LANES;
  uint patch_index = group_index() * (64 / LANES) + gl_LocalInvocationID.x / LANES;
  vec3 sum = vec3(0);
  if (patch_index < patches)
    for (uint k = lane; k < points_of_patch; k += LANES) sum += received_at(patch_index * points_of_patch + k);
#if LANES > 1
  sums[gl_LocalInvocationID.x] = sum;
  for (uint width = LANES / 2; width > 0; width /= 2) {
    barrier();
    if (lane < width) sums[gl_LocalInvocationID.x] += sums[gl_LocalInvocationID.x + width];
  }
  sum = sums[gl_LocalInvocationID.x];
#endif
  if (patch_index >= patches || lane > 0) return;
  for (uint colour = 0; colour < 3; ++colour) {
    uint here = colour * stride + patch_index;
    emission[here] = own[here] + reflectance[here] * sum[colour] / float(points_of_patch);
  }
}
