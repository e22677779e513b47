// E of each patch from the sums of injection_sums.comp, which are 0 again after that.
#include "groups.glsl"
#include "frame_block.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Sums { uint sums[]; };
layout(std430, binding = 1) readonly buffer Reflectance { float reflectance[]; };
layout(std430, binding = 2) readonly buffer Own { float own[]; };
layout(std430, binding = 3) writeonly buffer Emission { float emission[]; };
layout(std430, binding = 4) readonly buffer Areas { float areas[]; };

uniform uint patches;
uniform uint stride;  // between columns

void main() {
  uint patch_index = group_index() * 64 + gl_LocalInvocationID.x;
  if (patch_index >= patches) return;
  const float whole = 4 * 3.14159265;
  vec3 power = vec3(0);
  for (uint light = 0; light < uint(scalars.z); ++light) {
    power += lights[light].intensity.rgb * (whole / 2147483648.0 * float(sums[light * patches + patch_index]));
    sums[light * patches + patch_index] = 0;
  }
  for (uint colour = 0; colour < 3; ++colour) {
    uint here = colour * stride + patch_index;
    emission[here] = own[here] + reflectance[here] * power[colour] / areas[patch_index];
  }
}
