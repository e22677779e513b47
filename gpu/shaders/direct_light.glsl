// Light that arrives straight from the lights of frame_block.glsl, W/m^2.
layout(binding = 0) uniform sampler2DArray shadow_maps;  // 1 - nearest / depth along the axis of the face

vec3 unshadowed(Light light, vec3 point, vec3 normal) {
  vec3 way = light.position.xyz - point;
  float square = dot(way, way);
  float inverse_distance = inversesqrt(square);
  float cosine = dot(way, normal) * inverse_distance;
  if (cosine <= 0) return vec3(0);
  float part = 1;
  if (light.intensity.w == 1)
    part = smoothstep(light.axis.w, light.map.x, -dot(way, light.axis.xyz) * inverse_distance);
  return part * cosine / square * light.intensity.rgb;
}

// A point of a surface as a shadow map sees it.
struct Shaded {
  int layer;
  float extent;
  vec2 texel;     // where it is on the map
  vec3 plane;     // 1 / depth of its plane at (s, t, 1) along right, up, forward
  float closeness;  // its own 1 / depth
};

Shaded shaded(Light light, vec3 point, vec3 normal) {
  vec3 way = point - light.position.xyz;
  int layer = int(light.map.y);
  if (light.intensity.w == 0) {  // the cube's face: the largest component
    vec3 size = abs(way);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    layer += 2 * axis + (way[axis] < 0 ? 1 : 0);
  }
  Face face = faces[layer];
  vec3 local = vec3(dot(face.right.xyz, way), dot(face.up.xyz, way), dot(face.forward.xyz, way));
  vec3 local_normal = vec3(dot(face.right.xyz, normal), dot(face.up.xyz, normal), dot(face.forward.xyz, normal));
  Shaded result;
  result.layer = layer;
  result.extent = face.forward.w;
  result.texel = (local.xy / (local.z * face.forward.w) * 0.5 + 0.5) * scalars.w;
  result.plane = local_normal / dot(local_normal, local);
  result.closeness = 1 / local.z;
  return result;
}

// 1 where the light reaches the point as far as one texel of its map knows, else 0. The map has the depth at the
// middle of the texel, so that the depth of the point's own plane is taken there too: a surface throws no shadow on
// itself, however steep. What blocks must be nearer by two texels, since in a corner of a room that middle may lie on
// the other wall, and by the resolution of depth.
float reached(Shaded point, ivec2 texel) {
  texel = clamp(texel, ivec2(0), ivec2(int(scalars.w) - 1));
  vec2 place = ((vec2(texel) + 0.5) / scalars.w * 2 - 1) * point.extent;
  float closeness = max(dot(point.plane, vec3(place, 1)), point.closeness);
  float blocker = (1 - texelFetch(shadow_maps, ivec3(texel, point.layer), 0).r) / scalars.y;
  return blocker <= (1 + 4 * point.extent / scalars.w) * closeness + 1e-6 / scalars.y ? 1 : 0;
}

// By the texel that the point is in.
float lit_or_not(Light light, vec3 point, vec3 normal) {
  Shaded here = shaded(light, point, normal);
  return reached(here, ivec2(floor(here.texel)));
}

// Bilinear over the four texels around it: shadows without steps.
float lit_smoothly(Light light, vec3 point, vec3 normal) {
  Shaded here = shaded(light, point, normal);
  vec2 corner = floor(here.texel - 0.5);
  vec2 part = here.texel - 0.5 - corner;
  ivec2 texel = ivec2(corner);
  float low = mix(reached(here, texel), reached(here, texel + ivec2(1, 0)), part.x);
  float high = mix(reached(here, texel + ivec2(0, 1)), reached(here, texel + ivec2(1, 1)), part.x);
  return mix(low, high, part.y);
}
