#include "form_factors/shaft.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

using Eigen::Vector3d;

constexpr double kTouch = 1e-9;

bool behind(const ConvexPolygon& polygon, const Plane& plane) {
  for (int k = 0; k < polygon.corner_count(); ++k)
    if (plane.height(polygon[k]) > kTouch) return false;
  return true;
}

Plane plane_of(const ConvexPolygon& polygon) {
  Plane plane{polygon.area_vector().normalized(), 0};
  plane.offset = plane.normal.dot(polygon[0]);
  return plane;
}

struct HeightRange {
  double low = 1e300, high = -1e300;
};

HeightRange heights(const ShaftEnd& end, const Plane& plane) {
  HeightRange range;
  for (const Vector3d& point : end.hull) {
    const double height = plane.height(point);
    range.low = std::min(range.low, height);
    range.high = std::max(range.high, height);
  }
  return range;
}

// Chung and Wang's separating vector algorithm (1996): reflect the trial direction until it separates. Gives up after a
// few steps, which only costs a proof.
bool separated(const ConvexPolygon& blocker, const ShaftEnd& first, const ShaftEnd& second) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : first.hull) middle += point / static_cast<double>(2 * first.hull.size());
  for (const Vector3d& point : second.hull) middle += point / static_cast<double>(2 * second.hull.size());
  Vector3d center = Vector3d::Zero();
  for (int k = 0; k < blocker.corner_count(); ++k) center += blocker[k] / blocker.corner_count();
  Vector3d direction = (center - middle);
  if (direction.squaredNorm() < 1e-24) return false;
  direction.normalize();
  constexpr int steps = 12;
  for (int step = 0; step < steps; ++step) {
    double shaft_high = -1e300, blocker_low = 1e300;
    Vector3d shaft_point = middle, blocker_point = center;
    for (const ShaftEnd* end : {&first, &second})
      for (const Vector3d& point : end->hull) {
        const double along = direction.dot(point);
        if (along > shaft_high) shaft_high = along, shaft_point = point;
      }
    for (int k = 0; k < blocker.corner_count(); ++k) {
      const double along = direction.dot(blocker[k]);
      if (along < blocker_low) blocker_low = along, blocker_point = blocker[k];
    }
    if (blocker_low > shaft_high + kTouch) return true;
    Vector3d apart = shaft_point - blocker_point;
    const double length = apart.norm();
    if (length < 1e-12) return false;
    apart /= length;
    direction -= 2 * direction.dot(apart) * apart;
    direction.normalize();
  }
  return false;
}

}  // namespace

bool misses_shaft(const ConvexPolygon& blocker, const ShaftEnd& first, const ShaftEnd& second) {
  if (first.plane && behind(blocker, *first.plane)) return true;
  if (second.plane && behind(blocker, *second.plane)) return true;
  const Plane plane = plane_of(blocker);
  const HeightRange a = heights(first, plane), b = heights(second, plane);
  if (std::min(a.low, b.low) >= -kTouch || std::max(a.high, b.high) <= kTouch) return true;
  return separated(blocker, first, second);
}

bool blocks_shaft(const ConvexPolygon& blocker, const ShaftEnd& first, const ShaftEnd& second) {
  const Plane plane = plane_of(blocker);
  const HeightRange a = heights(first, plane), b = heights(second, plane);
  const bool opposite = (a.low > kTouch && b.high < -kTouch) || (b.low > kTouch && a.high < -kTouch);
  if (!opposite) return false;
  for (const Vector3d& p : first.hull) {
    const double height_p = plane.height(p);
    for (const Vector3d& q : second.hull) {
      const Vector3d crossing = p + (q - p) * (height_p / (height_p - plane.height(q)));
      for (int k = 0; k < blocker.corner_count(); ++k) {
        const Vector3d edge = blocker.next(k) - blocker[k];
        if (edge.cross(crossing - blocker[k]).dot(plane.normal) < 0) return false;
      }
    }
  }
  return true;
}

}  // namespace radiosity
