#pragma once

#include "scene/scene.hpp"

#include <array>
#include <vector>

namespace radiosity {

/// The quads of a box, counter-clockwise seen from inside, in the order of kBoxSides.
using BoxFaces = std::array<std::vector<Vector3>, 6>;

constexpr std::array<const char*, 6> kBoxSides = {"floor", "ceiling", "left", "right", "back", "front"};

/// Of the box centre + (+-1) half[0] + (+-1) half[1] + (+-1) half[2], the half edges right-handed: to the
/// right, up and to the front.
BoxFaces box_seen_from_inside(const Vector3& centre, const std::array<Vector3, 3>& half);
BoxFaces box_seen_from_outside(const Vector3& centre, const std::array<Vector3, 3>& half);

/// Half edges along the axes of a cube.
std::array<Vector3, 3> cube_halves(double side);

}  // namespace radiosity
