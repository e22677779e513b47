#include "scene/voxel_grid.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

// How far, relative to a cell, something passes a border before it counts: float32 files are not exacter.
constexpr double kBorder = 1e-6;
constexpr double kMostCells = 1 << 20;

}  // namespace

VoxelGrid::VoxelGrid(const Eigen::AlignedBox3d& box, double edge) : box_(box) {
  const Vector3 sides = box.sizes();
  if (!(edge > 0) || sides.maxCoeff() / edge > kMostCells)
    fail<UsageError>(
        "voxels of {:.3g} are too small for a scene of {:.3g}: at most 2^20 are possible each way", edge,
        sides.maxCoeff());
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = std::max(1, static_cast<int>(std::lround(sides[axis] / edge)));
    cell_[axis] = sides[axis] > 0 ? sides[axis] / counts_[axis] : edge;
  }
}

double VoxelGrid::plane(int axis, int k) const {
  return k == counts_[axis] ? box_.max()[axis] : box_.min()[axis] + k * cell_[axis];
}

std::pair<int, int> VoxelGrid::range(int axis, double low, double high, int front) const {
  const double from = (low - box_.min()[axis]) / cell_[axis];
  const double to = (high - box_.min()[axis]) / cell_[axis];
  int first = static_cast<int>(std::floor(from + kBorder));
  int last = static_cast<int>(std::ceil(to - kBorder)) - 1;
  if (last < first) first = last = front > 0 ? std::max(first, last) : std::min(first, last);
  const int end = counts_[axis] - 1;
  return {std::clamp(first, 0, end), std::clamp(last, 0, end)};
}

Eigen::Array3i VoxelGrid::cell_of(const Vector3& point) const {
  const Eigen::Array3d place = (point - box_.min()).array() / cell_.array();
  return place.floor().max(0).min((counts_ - 1).cast<double>()).cast<int>();
}

std::uint64_t VoxelGrid::number(const Eigen::Array3i& cell) const {
  const auto wide = [](int value) { return static_cast<std::uint64_t>(value); };
  return (wide(cell.z()) * wide(counts_.y()) + wide(cell.y())) * wide(counts_.x()) + wide(cell.x());
}

std::pair<Polygon, Polygon> split_at(const Polygon& polygon, int axis, double plane, double tolerance) {
  const auto height = [&](const Vector3& point) {
    const double d = point[axis] - plane;
    return std::abs(d) <= tolerance ? 0.0 : d;
  };
  Polygon below, above;
  bool any_below = false, any_above = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3& here = polygon[k];
    const Vector3& next = polygon[(k + 1) % polygon.size()];
    const double d = height(here), d_next = height(next);
    any_below = any_below || d < 0;
    any_above = any_above || d > 0;
    if (d <= 0) below.push_back(here);
    if (d >= 0) above.push_back(here);
    if (d * d_next < 0) {
      Vector3 crossing = here + d / (d - d_next) * (next - here);
      crossing[axis] = plane;
      below.push_back(crossing);
      above.push_back(crossing);
    }
  }
  if (!any_above) return {polygon, {}};
  if (!any_below) return {{}, polygon};
  return {std::move(below), std::move(above)};
}

}  // namespace radiosity
