#include "experiments/disc_cover.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double signed_angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// Signed area of the triangle (origin, a, b) inside the disc. The part of the edge that lies inside spans a
/// triangle, the parts before and after it span sectors.
double disc_triangle_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius) {
  const Eigen::Vector2d edge = b - a;
  const double squared_length = edge.squaredNorm();
  if (squared_length == 0) return 0;
  const double nearest = -a.dot(edge) / squared_length;
  const double squared_distance = (a + nearest * edge).squaredNorm();
  const double squared_half_chord = radius * radius - squared_distance;
  const double sector = 0.5 * radius * radius;
  if (squared_half_chord <= 0) return sector * signed_angle(a, b);
  const double half_chord = std::sqrt(squared_half_chord / squared_length);
  const double enter = std::clamp(nearest - half_chord, 0.0, 1.0);
  const double leave = std::clamp(nearest + half_chord, 0.0, 1.0);
  if (enter >= leave) return sector * signed_angle(a, b);
  const Eigen::Vector2d first = a + enter * edge;
  const Eigen::Vector2d last = a + leave * edge;
  double area = 0.5 * cross(first, last);
  if (enter > 0) area += sector * signed_angle(a, first);
  if (leave < 1) area += sector * signed_angle(last, b);
  return area;
}

}  // namespace

double disc_polygon_area(std::span<const Eigen::Vector2d> polygon, double radius) {
  double area = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    area += disc_triangle_area(polygon[k], polygon[(k + 1) % polygon.size()], radius);
  return std::max(area, 0.0);
}

}  // namespace radiosity
