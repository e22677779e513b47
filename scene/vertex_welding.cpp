#include "scene/vertex_welding.hpp"

#include "foundation/random.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace radiosity {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t state = 0;
    for (const std::int64_t i : cell) state = mix_bits(state ^ static_cast<std::uint64_t>(i));
    return state;
  }
};

// Cells four tolerances wide: a point has neighbours in at most one adjacent cell along each axis.
struct Neighbourhood {
  Cell cell{};
  Cell other{};  // equal to `cell` along an axis where no other cell is near
};

Neighbourhood neighbourhood(const Vector3& point, const Vector3& origin, double tolerance) {
  Neighbourhood result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double position = (point[axis] - origin[axis]) / (4 * tolerance);
    const double base = std::floor(position);
    result.cell[i] = static_cast<std::int64_t>(base);
    const double fraction = position - base;
    result.other[i] = result.cell[i] + (fraction < 0.26 ? -1 : fraction > 0.74 ? 1 : 0);
  }
  return result;
}

}  // namespace

std::vector<int> weld(const std::vector<Vector3>& points, double tolerance) {
  std::vector<int> representative(points.size());
  if (points.empty()) return representative;
  // Never below what doubles can tell apart at these coordinates: cell numbers stay within 53 bits.
  double extent = 0;
  for (const Vector3& point : points)
    extent = std::max(extent, (point - points.front()).cwiseAbs().maxCoeff());
  const double radius = std::max(tolerance, extent * 1e-15);
  if (radius == 0) return std::vector<int>(points.size(), 0);

  std::unordered_map<Cell, std::vector<int>, CellHash> cells;
  cells.reserve(points.size());
  const auto find = [&](const Vector3& point, const Neighbourhood& near) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      Cell cell = near.cell;
      bool repeated = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (((corner >> axis) & 1U) == 0) continue;
        repeated |= near.other[axis] == near.cell[axis];
        cell[axis] = near.other[axis];
      }
      if (repeated) continue;
      const auto found = cells.find(cell);
      if (found == cells.end()) continue;
      for (const int candidate : found->second)
        if ((points[static_cast<std::size_t>(candidate)] - point).norm() <= radius) return candidate;
    }
    return -1;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Neighbourhood near = neighbourhood(points[i], points.front(), radius);
    const int found = find(points[i], near);
    representative[i] = found >= 0 ? found : static_cast<int>(i);
    if (found < 0) cells[near.cell].push_back(static_cast<int>(i));
  }
  return representative;
}

}  // namespace radiosity
