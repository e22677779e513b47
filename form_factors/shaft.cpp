#include "form_factors/shaft.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

using Eigen::Vector3d;

constexpr double kTouch = 1e-9;

struct HeightRange {
  double low = 1e300, high = -1e300;
};

HeightRange heights(const ShaftEnd& end, const Plane& plane) {
  HeightRange range;
  for (const Vector3d& point : end) {
    const double height = plane.height(point);
    range.low = std::min(range.low, height);
    range.high = std::max(range.high, height);
  }
  return range;
}

bool holds(const Blocker& blocker, const Vector3d& p) {
  const BlockerPlanes& planes = blocker.planes;
  for (int k = 0; k < blocker.polygon.corner_count(); ++k) {
    const double* const inward = planes.edge_normal[k];
    if (inward[0] * p.x() + inward[1] * p.y() + inward[2] * p.z() < planes.edge_offset[k]) return false;
  }
  return true;
}

Vector3d crossing(const Vector3d& p, double height_p, const Vector3d& q, double height_q) {
  return p + (q - p) * (height_p / (height_p - height_q));
}

Vector3d middle(const ShaftEnd& end) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : end) sum += point;
  return sum / static_cast<double>(end.size());
}

struct Support {
  double along;
  const Vector3d* point;
};

Support highest(const Vector3d& direction, const ShaftEnd& first, const ShaftEnd& second) {
  Support support{-1e300, nullptr};
  for (const ShaftEnd* end : {&first, &second})
    for (const Vector3d& point : *end) {
      const double along = direction.dot(point);
      if (along > support.along) support = {along, &point};
    }
  return support;
}

Support lowest(const Vector3d& direction, const ConvexPolygon& polygon) {
  Support support{1e300, nullptr};
  for (const Vector3d& corner : polygon.corners()) {
    const double along = direction.dot(corner);
    if (along < support.along) support = {along, &corner};
  }
  return support;
}

}  // namespace

Blocker::Blocker(const ConvexPolygon& face) : polygon(face), center(Vector3d::Zero()) {
  plane.normal = face.area_vector().normalized();
  plane.offset = plane.normal.dot(face[0]);
  for (int k = 0; k < face.corner_count(); ++k) center += face[k] / face.corner_count();
  for (int k = 0; k < 4; ++k) {
    const int edge = std::min(k, face.corner_count() - 1);
    const Vector3d inward = plane.normal.cross(face.next(edge) - face[edge]);
    for (int axis = 0; axis < 3; ++axis) planes.edge_normal[k][axis] = inward[axis];
    planes.edge_offset[k] = inward.dot(face[edge]);
  }
  for (int axis = 0; axis < 3; ++axis) planes.normal[axis] = plane.normal[axis];
  planes.offset = plane.offset;
}

double lowest(const Vector3d& direction, const Blocker& blocker) {
  return lowest(direction, blocker.polygon).along;
}

// Chung and Wang's separating vector algorithm (1996): reflect the trial direction until it separates. Gives
// up after a few steps, which only costs a proof.
bool separate(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second, Vector3d& direction) {
  if (direction.squaredNorm() == 0) direction = blocker.center - 0.5 * (middle(first) + middle(second));
  if (direction.squaredNorm() < 1e-24) return false;
  direction.normalize();
  constexpr int steps = 6;
  for (int step = 0; step < steps; ++step) {
    const Support shaft = highest(direction, first, second);
    const Support face = lowest(direction, blocker.polygon);
    if (face.along > shaft.along + kTouch) return true;
    Vector3d apart = *shaft.point - *face.point;
    const double length = apart.norm();
    if (length < 1e-12) return false;
    apart /= length;
    direction -= 2 * direction.dot(apart) * apart;
  }
  return false;
}

bool misses_shaft(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second) {
  const Vector3d from = middle(first), to = middle(second);
  const double height_from = blocker.plane.height(from), height_to = blocker.plane.height(to);
  if (height_from * height_to < 0 && holds(blocker, crossing(from, height_from, to, height_to))) return false;
  Vector3d direction = Vector3d::Zero();
  return separate(blocker, first, second, direction);
}

bool blocks_shaft(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second) {
  const HeightRange a = heights(first, blocker.plane), b = heights(second, blocker.plane);
  const bool opposite = (a.low > kTouch && b.high < -kTouch) || (b.low > kTouch && a.high < -kTouch);
  if (!opposite) return false;
  for (const Vector3d& p : first) {
    const double height_p = blocker.plane.height(p);
    for (const Vector3d& q : second)
      if (!holds(blocker, crossing(p, height_p, q, blocker.plane.height(q)))) return false;
  }
  return true;
}

}  // namespace radiosity
