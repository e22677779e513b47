#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <span>

namespace radiosity {

/// Heights up to this count as "in the plane", in a scene scaled to a box of side 1: what float32 coordinates
/// of a file leave open. So the bottom of a box that stands on a floor does not see the floor through a gap
/// of rounding.
inline constexpr double coplanar_slack = 3e-7;

/// A planar convex polygon of a few corners, counter-clockwise seen from its front. A patch has 3 or 4
/// corners; a patch clipped by one plane has at most one more.
class ConvexPolygon {
 public:
  static constexpr int max_corners = 8;

  int corner_count() const { return count_; }
  const Eigen::Vector3d& operator[](int k) const { return corners_[static_cast<std::size_t>(k)]; }
  Eigen::Vector3d& operator[](int k) { return corners_[static_cast<std::size_t>(k)]; }
  const Eigen::Vector3d& next(int k) const { return (*this)[k + 1 == count_ ? 0 : k + 1]; }

  std::span<const Eigen::Vector3d> corners() const {
    return {corners_.data(), static_cast<std::size_t>(count_)};
  }

  /// Corners beyond max_corners are ignored: no patch has that many.
  void add(const Eigen::Vector3d& corner) {
    if (count_ < max_corners) corners_[static_cast<std::size_t>(count_++)] = corner;
  }

  /// Length is the area, direction the front normal; zero for fewer than 3 corners.
  Eigen::Vector3d area_vector() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 1; k + 1 < count_; ++k) sum += ((*this)[k] - (*this)[0]).cross((*this)[k + 1] - (*this)[0]);
    return 0.5 * sum;
  }

 private:
  std::array<Eigen::Vector3d, max_corners> corners_;
  int count_ = 0;
};

/// The points x with normal . x = offset.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, towards the front
  double offset = 0;

  double height(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

/// The part of a polygon in front of a plane; corners within `slack` of the plane count as on it. Empty
/// (fewer than 3 corners) if nothing is in front.
inline ConvexPolygon clip(const ConvexPolygon& polygon, const Plane& plane, double slack) {
  ConvexPolygon front;
  bool anything = false;
  for (int k = 0; k < polygon.corner_count(); ++k) {
    const Eigen::Vector3d& here = polygon[k];
    const Eigen::Vector3d& there = polygon.next(k);
    const double height_here = plane.height(here), height_there = plane.height(there);
    if (height_here > slack) anything = true;
    if (height_here >= -slack) front.add(here);
    const bool crosses =
        (height_here > slack && height_there < -slack) || (height_here < -slack && height_there > slack);
    if (crosses) front.add(here + (there - here) * (height_here / (height_here - height_there)));
  }
  return anything ? front : ConvexPolygon{};
}

}  // namespace radiosity
