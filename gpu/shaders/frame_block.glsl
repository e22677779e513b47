// What changes from frame to frame (frame/frame_block.hpp).
struct Light {
  vec4 position;
  vec4 intensity;  // W/sr; then 1 for spots, 0 for points
  vec4 axis;       // unit vector; the cosine at which a spot ends
  vec4 map;        // the cosine from which on it shines in full, the first layer of its shadow map
};
struct Face {
  vec4 right;
  vec4 up;
  vec4 forward;  // and how far the map reaches along right and up where forward is 1
};
layout(std140, binding = 0) uniform FrameBlock {
  mat4 view_projection;
  vec4 scalars;  // exposure, nearest depth of shadow maps, lights, texels of a side
  Light lights[4];
  Face faces[24];
};
