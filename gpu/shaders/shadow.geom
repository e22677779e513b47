// Each triangle into the LAYERS maps of a light, where it may be seen there.
#include "frame_block.glsl"

layout(triangles, invocations = LAYERS) in;
layout(triangle_strip, max_vertices = 3) out;

uniform uint light;

void main() {
  int layer = int(lights[light].map.y) + gl_InvocationID;
  Face face = faces[layer];
  vec3 seen[3];  // x and y in [-z, z] on the map
  for (int k = 0; k < 3; ++k) {
    vec3 way = gl_in[k].gl_Position.xyz - lights[light].position.xyz;
    seen[k] = vec3(dot(face.right.xyz, way) / face.forward.w, dot(face.up.xyz, way) / face.forward.w,
                   dot(face.forward.xyz, way));
  }
  bvec3 outside_low = bvec3(true);
  bvec3 outside_high = bvec3(true);
  for (int k = 0; k < 3; ++k) {
    outside_low = bvec3(outside_low.x && seen[k].x < -seen[k].z, outside_low.y && seen[k].y < -seen[k].z,
                        outside_low.z && seen[k].z < 0);
    outside_high = bvec3(outside_high.x && seen[k].x > seen[k].z, outside_high.y && seen[k].y > seen[k].z, false);
  }
  if (any(outside_low) || any(outside_high)) return;
  for (int k = 0; k < 3; ++k) {
    gl_Layer = layer;
    gl_Position = vec4(seen[k].xy, seen[k].z - 2 * scalars.y, seen[k].z);  // depth 1 - nearest / z
    EmitVertex();
  }
  EndPrimitive();
}
