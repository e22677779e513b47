#include "scene/rectilinear_space.hpp"

#include <algorithm>

namespace radiosity {
namespace {

using GridCell = RectilinearSpace::Cell;

int cell_count(const RectilinearSpace& space, int axis) {
  return static_cast<int>(space.planes[static_cast<std::size_t>(axis)].size()) - 1;
}

bool is_inside_and_free(const RectilinearSpace& space, const GridCell& cell) {
  for (int axis = 0; axis < 3; ++axis) {
    const int at = cell[static_cast<std::size_t>(axis)];
    if (at < 0 || at >= cell_count(space, axis)) return false;
  }
  return space.is_free(cell);
}

/// The side of a cell at its lower (0) or upper (1) plane normal to `axis`.
RectilinearWall side_of(const RectilinearSpace& space, const GridCell& cell, int axis, int upper) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
  const auto w = static_cast<std::size_t>(axis);
  const auto plane = [&](std::size_t along, int step) {
    return space.planes[along][static_cast<std::size_t>(cell[along] + step)];
  };
  RectilinearWall wall{{}, cell, axis, upper == 0};
  for (const auto& [du, dv] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Vector3& corner = wall.corners.emplace_back();
    corner[axis] = plane(w, upper);
    corner[(axis + 1) % 3] = plane(u, du);
    corner[(axis + 2) % 3] = plane(v, dv);
  }
  if (!wall.faces_up) std::reverse(wall.corners.begin(), wall.corners.end());
  return wall;
}

void add_walls_of_cell(const RectilinearSpace& space, const GridCell& cell,
                       std::vector<RectilinearWall>& walls) {
  if (!is_inside_and_free(space, cell)) return;
  for (int axis = 0; axis < 3; ++axis)
    for (const int upper : {0, 1}) {
      GridCell neighbour = cell;
      neighbour[static_cast<std::size_t>(axis)] += 2 * upper - 1;
      if (!is_inside_and_free(space, neighbour)) walls.push_back(side_of(space, cell, axis, upper));
    }
}

}  // namespace

std::vector<RectilinearWall> walls_of(const RectilinearSpace& space) {
  std::vector<RectilinearWall> walls;
  for (int x = 0; x < cell_count(space, 0); ++x)
    for (int y = 0; y < cell_count(space, 1); ++y)
      for (int z = 0; z < cell_count(space, 2); ++z) add_walls_of_cell(space, {x, y, z}, walls);
  return walls;
}

}  // namespace radiosity
