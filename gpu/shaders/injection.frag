// The number of the triangle that a light sees.
layout(location = 0) flat in uint drawn;
layout(location = 0) out uint triangle;

void main() {
  triangle = drawn;
}
