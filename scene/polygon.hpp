#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace radiosity {

/// A plane polygon in space: corners in order.
using Polygon = std::vector<Vector3>;

/// Length is the area, direction the normal from which the corners run counter-clockwise.
Vector3 area_vector(const Polygon& polygon);

/// Whether every corner turns left (or goes straight, within `tolerance`) seen from `normal`.
bool is_convex(const Polygon& polygon, const Vector3& normal, double tolerance);

/// Whether a point of its plane lies in a convex polygon that runs counter-clockwise seen from `normal`, or
/// outside by no more than `tolerance` times the length of an edge.
bool contains(const Polygon& polygon, const Vector3& point, const Vector3& normal, double tolerance);

/// The parts of a convex polygon left and right of the line from `from` to `to` seen from `normal`. Corners
/// within `tolerance` of the line count as on it; a part without area is empty.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const Vector3& from, const Vector3& to,
                                  const Vector3& normal, double tolerance);

/// Whether two convex polygons in one plane share more than a boundary. Both counter-clockwise seen from
/// `normal`.
bool overlap(const Polygon& a, const Polygon& b, const Vector3& normal, double tolerance);

/// Triangles, as corner numbers, that fill a simple polygon (within its tolerance also one that is not quite
/// plane) which runs counter-clockwise seen from `normal`; by ear clipping, roundest ear first. Nothing if
/// its boundary crosses itself.
std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon, const Vector3& normal,
                                                    double tolerance);

/// Convex parts of a simple polygon that runs counter-clockwise seen from `normal`: itself, or triangles.
/// Nothing if its boundary crosses itself.
std::vector<Polygon> convex_parts(const Polygon& polygon, const Vector3& normal, double tolerance);

/// What remains of a convex polygon without the convex `cover`, as convex polygons. Of the ways to cut, the
/// one whose worst piece is the least narrow.
std::vector<Polygon> subtract(const Polygon& polygon, const Polygon& cover, const Vector3& normal,
                              double tolerance);

/// A convex polygon as triangles and convex quads, the worst of which is as little narrow as a greedy choice
/// finds.
std::vector<Polygon> triangles_and_quads(const Polygon& polygon);

}  // namespace radiosity
