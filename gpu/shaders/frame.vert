// What the camera sees: vertices of the shown mesh with their indirect light.
#include "frame_block.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 irradiance;
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 indirect;

void main() {
  place = position;
  indirect = irradiance.rgb;
  gl_Position = view_projection * vec4(position, 1);
}
