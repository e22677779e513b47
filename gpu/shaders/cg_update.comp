// w += alpha p, r -= alpha q, and the sums of r^2 and (W r)^2.
#include "groups.glsl"
#include "fields.glsl"

layout(std430, binding = 1) readonly buffer Scalars { vec4 scalars[]; };  // r^2, alpha, beta, (W r)^2 of a column
layout(std430, binding = 3) readonly buffer Direction { float direction[]; };
layout(std430, binding = 4) readonly buffer Image { float image[]; };
layout(std430, binding = 5) buffer Solution { float solution[]; };
layout(std430, binding = 6) buffer Residual { float residual[]; };

void main() {
  if (field_column() >= columns) return;  // the whole group
  uint place = field_place();
  float alpha = scalars[field_column()].y;
  solution[place] += alpha * direction[place];
  float rest = residual[place] - alpha * image[place];
  residual[place] = rest;
  float weighted = diagonal(2) * rest;
  add_up(float[SUMS](rest * rest, weighted * weighted));
}
