#pragma once

#include "scene/face_subdivision.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiosity {

/// How to cut faces into cells such that quads that share an edge cut it alike.
struct ConformingCells {
  std::vector<GridSize> sizes;  ///< one a face; of quads
  double edge = 0;              ///< longest edge allowed in triangles
};

/// Cells for about `count` patches: edges no longer than needed, and then one more cut through those chains
/// of quads (each shares an edge with the next) whose cells are longest, as long as `count` is not exceeded.
/// Faces may be empty.
ConformingCells conforming_cells(const std::vector<Polygon>& faces, std::int64_t count);

/// The longest edge allowed for which `count_for(edge)`, which falls in steps as the edge grows, is still at
/// least `count` (first) and the shortest for which it is not (second), by halving the interval in the
/// logarithm. `start`: where to begin.
template <typename CountFor>
std::pair<double, double> edges_around(double start, std::int64_t count, const CountFor& count_for) {
  double fine = start;
  while (count_for(fine) < count) fine /= 2;
  double coarse = fine;
  while (count_for(coarse) > count && coarse < 1e6 * fine) coarse *= 2;
  for (int step = 0; step < 40 && coarse > fine * (1 + 1e-9); ++step) {
    const double middle = std::sqrt(fine * coarse);
    (count_for(middle) >= count ? fine : coarse) = middle;
  }
  return {fine, coarse};
}

}  // namespace radiosity
