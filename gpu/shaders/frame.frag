// Radiance times the exposure: own emission, direct light with shadows at this pixel, interpolated indirect light.
#include "frame_block.glsl"
#include "direct_light.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 indirect;
layout(location = 0) out vec4 colour;

layout(std430, binding = 0) readonly buffer Triangles { uint triangle_patch[]; };
layout(std430, binding = 1) readonly buffer Surfaces { vec4 surfaces[]; };  // normal, reflectance, emission of a patch

void main() {
  uint shown = 3 * triangle_patch[gl_PrimitiveID];
  vec3 normal = surfaces[shown].xyz;
  vec3 received = indirect;
  for (int k = 0; k < int(scalars.z); ++k) {
    vec3 light = unshadowed(lights[k], place, normal);
    if (light != vec3(0)) received += light * lit_smoothly(lights[k], place, normal);
  }
  const float pi = 3.14159265;
  vec3 radiance = (surfaces[shown + 2].rgb + surfaces[shown + 1].rgb * received) / pi;
  colour = vec4(radiance * scalars.x, 1);
}
