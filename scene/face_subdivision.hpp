#pragma once

#include "scene/polygon.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

/// rows x columns: `columns` cells along the first edge of a quad, `rows` along the second.
struct GridSize {
  std::int64_t rows = 1;
  std::int64_t columns = 1;
};

/// The fewest cells along a length with none above `edge`.
std::int64_t cells_along(double length, double edge);

/// The fewest rows and columns whose cells have no edge above `edge`.
GridSize grid_size(const Polygon& quad, double edge);

/// Bilinear cells of a plane convex quad, row by row; of a rectangle, rectangles.
std::vector<Polygon> grid(const Polygon& quad, GridSize size);

/// Halves a triangle across its longest edge (the first of equals), and the halves again, until no edge is
/// above `edge` or a part has been halved `passes` times (0: no limit). Neighbours are not matched.
std::vector<Polygon> bisect(const Polygon& triangle, double edge, int passes);

/// How many parts bisect() gives, without building them.
std::int64_t bisection_count(const Polygon& triangle, double edge, int passes);

/// Halves the triangle with the longest edge among all, first come first among equals, until there are
/// `count`. Returns the parts of each triangle.
std::vector<std::vector<Polygon>> bisect_to_count(const std::vector<Polygon>& triangles, std::int64_t count);

}  // namespace radiosity
