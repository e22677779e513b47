// The irradiance of each vertex: the weighted mean of that of some patches (document 000, section 3.6, step 4).
#include "groups.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Begin { uint begin[]; };
layout(std430, binding = 1) readonly buffer Patches { uint patches[]; };
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };
layout(std430, binding = 3) readonly buffer Irradiance { float irradiance[]; };
layout(std430, binding = 4) writeonly buffer Vertices { vec4 vertices[]; };

uniform uint vertex_count;
uniform uint stride;  // between columns of the irradiance

void main() {
  uint vertex = group_index() * 64 + gl_LocalInvocationID.x;
  if (vertex >= vertex_count) return;
  vec3 sum = vec3(0);
  for (uint k = begin[vertex]; k < begin[vertex + 1]; ++k) {
    uint from = patches[k];
    sum += weights[k] * vec3(irradiance[from], irradiance[stride + from], irradiance[2 * stride + from]);
  }
  vertices[vertex] = vec4(sum, 0);
}
