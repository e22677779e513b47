// q = p - L y for y = M x, the image of the direction p, and the sums of p q.
#include "groups.glsl"
#include "fields.glsl"

layout(std430, binding = 2) readonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Direction { float direction[]; };
layout(std430, binding = 4) writeonly buffer Image { float image[]; };

void main() {
  if (field_column() >= columns) return;  // the whole group
  uint place = field_place();
  float own = direction[place];
  float result = own - diagonal(0) * y[place];
  image[place] = result;
  add_up(float[SUMS](own * result));
}
