#pragma once

#include "scene/polygon.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <utility>

namespace radiosity {

/// The cells of a box, counted along x, y and z. They fit the box: its walls lie in the outermost planes, so
/// that a box of a scene is cut into equal cells and none is a sliver; for that they are only as nearly cubic
/// as whole numbers allow.
class VoxelGrid {
 public:
  /// Each side of the box is divided by `edge`, rounded to whole cells and to one at least. Throws UsageError
  /// where a side would have more than 2^20 cells.
  VoxelGrid(const Eigen::AlignedBox3d& box, double edge);

  const Eigen::Array3i& counts() const { return counts_; }
  bool operator==(const VoxelGrid& other) const { return (counts_ == other.counts_).all(); }

  /// Sides of a cell, in scene units; where the box is flat, `edge`.
  const Vector3& cell() const { return cell_; }

  /// Coordinate of plane `k` across an axis, 0 <= k <= counts()[axis].
  double plane(int axis, int k) const;

  /// First and last cell along an axis of what reaches from `low` to `high`; borders that are passed by less
  /// than a millionth of a cell are not passed. What lies in a border plane belongs to the cell on its front,
  /// towards `front` (+1 or -1).
  std::pair<int, int> range(int axis, double low, double high, int front) const;

  /// The cell that a point is in, or the nearest one.
  Eigen::Array3i cell_of(const Vector3& point) const;

  /// A number for a cell, x running fastest.
  std::uint64_t number(const Eigen::Array3i& cell) const;

 private:
  Eigen::AlignedBox3d box_;
  Eigen::Array3i counts_;
  Vector3 cell_;
};

/// The parts of a convex polygon below and above a plane across an axis. Corners nearer than `tolerance`
/// count as on it; a part without area is empty. New corners lie exactly in the plane.
std::pair<Polygon, Polygon> split_at(const Polygon& polygon, int axis, double plane, double tolerance);

}  // namespace radiosity
