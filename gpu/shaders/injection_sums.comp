// The part of all directions of a light in which it sees each patch, from a picture of triangles around it (document
// 001): a pixel at (x, y), where what is seen is 1 ahead, has the solid angle of its area / (1 + x^2 + y^2)^(3/2).
// Parts are in units of 2^-31, so that sums do not depend on their order.
#include "groups.glsl"
#include "frame_block.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Triangles { uint triangle_patch[]; };
layout(std430, binding = 1) buffer Sums { uint sums[]; };  // of each patch, light by light
layout(binding = 1) uniform usampler2DArray seen;

uniform uint light;
uniform uint layers;
uniform uint size;  // pixels of a side
uniform uint patches;

void main() {
  uint pixel = group_index() * 64 + gl_LocalInvocationID.x;
  if (pixel >= layers * size * size) return;
  ivec3 place = ivec3(pixel % size, pixel / size % size, pixel / (size * size));
  uint drawn = texelFetch(seen, place, 0).r;
  if (drawn == 0) return;
  bool spot = lights[light].intensity.w == 1;
  float extent = spot ? faces[int(lights[light].map.y)].forward.w : 1;
  vec2 at = ((vec2(place.xy) + 0.5) / float(size) * 2 - 1) * extent;
  float inverse_distance = inversesqrt(1 + dot(at, at));
  float side = 2 * extent / float(size);
  float solid_angle = side * side * inverse_distance * inverse_distance * inverse_distance;
  float part = spot ? smoothstep(lights[light].axis.w, lights[light].map.x, inverse_distance) : 1;
  const float whole = 4 * 3.14159265;
  atomicAdd(sums[light * patches + triangle_patch[drawn - 1]], uint(part * solid_angle / whole * 2147483648.0 + 0.5));
}
