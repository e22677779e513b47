#pragma once

#include "scene/scene.hpp"

#include <array>
#include <functional>
#include <vector>

namespace radiosity {

/// Rooms with walls along the axes, as the free ones among the cells between planes.
struct RectilinearSpace {
  using Cell = std::array<int, 3>;

  std::array<std::vector<double>, 3> planes;  ///< per axis, increasing; one cell between any two that follow
  std::function<bool(const Cell&)> is_free;
};

/// Where a free cell ends at a solid one or at the outermost planes.
struct RectilinearWall {
  std::vector<Vector3> corners;  ///< a rectangle, counter-clockwise seen from the free cell
  RectilinearSpace::Cell cell;   ///< the free cell
  int axis = 0;                  ///< that the rectangle is normal to
  bool faces_up = false;         ///< whether its front looks along the axis, not against it
};

/// All walls of the free cells, cell by cell. They share whole edges only: the surface is watertight, and
/// stays without T-junctions where each wall is cut by the same rule.
std::vector<RectilinearWall> walls_of(const RectilinearSpace& space);

}  // namespace radiosity
