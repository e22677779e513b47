#include "scene/box_faces.hpp"

#include <algorithm>

namespace radiosity {

BoxFaces box_seen_from_inside(const Vector3& centre, const std::array<Vector3, 3>& half) {
  // x, y and z are -1 or 1.
  const auto corner = [&](int x, int y, int z) -> Vector3 {
    return centre + x * half[0] + y * half[1] + z * half[2];
  };
  return {{{corner(-1, -1, -1), corner(-1, -1, 1), corner(1, -1, 1), corner(1, -1, -1)},
           {corner(-1, 1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(-1, 1, 1)},
           {corner(-1, -1, -1), corner(-1, 1, -1), corner(-1, 1, 1), corner(-1, -1, 1)},
           {corner(1, -1, -1), corner(1, -1, 1), corner(1, 1, 1), corner(1, 1, -1)},
           {corner(-1, -1, -1), corner(1, -1, -1), corner(1, 1, -1), corner(-1, 1, -1)},
           {corner(-1, -1, 1), corner(-1, 1, 1), corner(1, 1, 1), corner(1, -1, 1)}}};
}

BoxFaces box_seen_from_outside(const Vector3& centre, const std::array<Vector3, 3>& half) {
  BoxFaces faces = box_seen_from_inside(centre, half);
  for (std::vector<Vector3>& face : faces) std::reverse(face.begin(), face.end());
  return faces;
}

std::array<Vector3, 3> cube_halves(double side) {
  return {0.5 * side * Vector3::UnitX(), 0.5 * side * Vector3::UnitY(), 0.5 * side * Vector3::UnitZ()};
}

}  // namespace radiosity
