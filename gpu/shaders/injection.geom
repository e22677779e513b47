// Each triangle of the patches into the LAYERS faces around a light, with its number (document 001: texel ids).
#include "frame_block.glsl"

layout(triangles, invocations = LAYERS) in;
layout(triangle_strip, max_vertices = 3) out;

layout(location = 0) flat out uint drawn;  // the number and one, or 0 where the light sees its back

uniform uint light;

void main() {
  Face face = faces[int(lights[light].map.y) + gl_InvocationID];
  float extent = LAYERS == 6 ? 1 : face.forward.w;  // of a cube each direction once
  vec3 way[3];
  for (int k = 0; k < 3; ++k) way[k] = gl_in[k].gl_Position.xyz - lights[light].position.xyz;
  bool front = dot(cross(way[1] - way[0], way[2] - way[0]), way[0]) < 0;
  for (int k = 0; k < 3; ++k) {
    drawn = front ? uint(gl_PrimitiveIDIn) + 1u : 0u;
    gl_Layer = gl_InvocationID;
    float depth = dot(face.forward.xyz, way[k]);
    gl_Position = vec4(dot(face.right.xyz, way[k]) / extent, dot(face.up.xyz, way[k]) / extent,
                       depth - 2 * scalars.y, depth);
    EmitVertex();
  }
  EndPrimitive();
}
