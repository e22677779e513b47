#include "form_factors/contour_exchange.hpp"

#include "form_factors/edge_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {

double contour_exchange(const ConvexPolygon& first, const ConvexPolygon& second, double tolerance) {
  // Scaled to unit size about the first corner, logarithms are of order 1 and cancel best.
  const Eigen::Vector3d& origin = first[0];
  double size_first = 0, size_second = 0, size = 0;
  for (int k = 0; k < first.corner_count(); ++k) {
    size_first = std::max(size_first, (first[k] - origin).norm());
    size = std::max(size, size_first);
  }
  for (int k = 0; k < second.corner_count(); ++k) {
    size_second = std::max(size_second, (second[k] - second[0]).norm());
    size = std::max(size, (second[k] - origin).norm());
  }
  if (size == 0) return 0;
  const double inverse = 1 / size;
  const auto scaled = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return (x - origin) * inverse; };

  double sum = 0;
  for (int k = 0; k < first.corner_count(); ++k) {
    const Eigen::Vector3d a0 = scaled(first[k]), a1 = scaled(first.next(k));
    const Eigen::Vector3d a = a1 - a0;
    const double a_length = a.norm();
    if (a_length == 0) continue;
    for (int l = 0; l < second.corner_count(); ++l) {
      const Eigen::Vector3d b0 = scaled(second[l]), b1 = scaled(second.next(l));
      const Eigen::Vector3d b = b1 - b0;
      const double lengths = a_length * b.norm();
      if (lengths == 0) continue;
      const double cosine = a.dot(b) / lengths;
      if (std::abs(cosine) < 1e-15) continue;
      sum += cosine * edge_log_integral(a0, a1, b0, b1, tolerance);
    }
  }
  return std::max(0.0, sum * size * size / (2 * std::numbers::pi));
}

}  // namespace radiosity
