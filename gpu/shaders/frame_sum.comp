// B = E - s y, number by number.
#include "groups.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 2) readonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Emission { float emission[]; };
layout(std430, binding = 4) writeonly buffer Radiosity { float radiosity[]; };

uniform uint numbers;     // a multiple of 64
uniform uint scale_bits;  // of s, a float

void main() {
  uint place = group_index() * 64 + gl_LocalInvocationID.x;
  if (place >= numbers) return;
  radiosity[place] = emission[place] - uintBitsToFloat(scale_bits) * y[place];
}
