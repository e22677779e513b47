#pragma once

#include <Eigen/Core>

#include <span>

namespace radiosity {

/// Area of a simple polygon (counter-clockwise, in the plane) inside the disc of `radius` around the origin:
/// exact, the sum over edges of the triangles and sectors that each spans with the origin.
double disc_polygon_area(std::span<const Eigen::Vector2d> polygon, double radius);

}  // namespace radiosity
