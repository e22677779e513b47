// B <- E + L y for y = M x, the input x <- R B of the next product, and the sums of (W change of B)^2.
#include "groups.glsl"
#include "fields.glsl"

layout(std430, binding = 1) writeonly buffer X { float x[]; };
layout(std430, binding = 2) readonly buffer Y { float y[]; };
layout(std430, binding = 3) readonly buffer Emission { float emission[]; };
layout(std430, binding = 4) buffer Radiosity { float radiosity[]; };

void main() {
  if (field_column() >= columns) return;  // the whole group
  uint place = field_place();
  float next = emission[place] + diagonal(0) * y[place];
  float change = diagonal(2) * (next - radiosity[place]);
  radiosity[place] = next;
  x[place] = diagonal(1) * next;
  add_up(float[SUMS](change * change));
}
