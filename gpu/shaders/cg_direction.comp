// p <- r + beta p, and the input x = R p of the next product.
#include "groups.glsl"
#include "fields.glsl"

layout(std430, binding = 1) writeonly buffer X { float x[]; };
layout(std430, binding = 2) readonly buffer Scalars { vec4 scalars[]; };  // r^2, alpha, beta, (W r)^2 of a column
layout(std430, binding = 3) buffer Direction { float direction[]; };
layout(std430, binding = 6) readonly buffer Residual { float residual[]; };

void main() {
  if (field_column() >= columns) return;  // the whole group
  uint place = field_place();
  float next = residual[place] + scalars[field_column()].z * direction[place];
  direction[place] = next;
  x[place] = diagonal(1) * next;
}
