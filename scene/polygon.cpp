#include "scene/polygon.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace radiosity {
namespace {

const Vector3& next_corner(const Polygon& polygon, std::size_t k) {
  return polygon[k + 1 < polygon.size() ? k + 1 : 0];
}

/// Distance of a point to the left of the line from `from` to `to`.
double left_of(const Vector3& point, const Vector3& from, const Vector3& to, const Vector3& normal) {
  return normal.cross(to - from).normalized().dot(point - from);
}

/// Area over squared diameter: 0.5 for a square, towards 0 for slivers.
double roundness(const Polygon& polygon) {
  double diameter = 0;
  for (const Vector3& a : polygon)
    for (const Vector3& b : polygon) diameter = std::max(diameter, (a - b).squaredNorm());
  return diameter > 0 ? area_vector(polygon).norm() / diameter : 0;
}

/// The quad of the corners from `k` on, and what is left of the polygon.
std::pair<Polygon, Polygon> cut_off_quad(const Polygon& polygon, std::size_t k) {
  Polygon corners = polygon;
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), corners.end());
  Polygon remainder(corners.begin() + 3, corners.end());
  remainder.push_back(corners.front());
  corners.resize(4);
  return {std::move(corners), std::move(remainder)};
}

/// Worst roundness of what the polygons become as patches, and their number.
struct Quality {
  double worst = std::numeric_limits<double>::infinity();
  std::size_t patches = 0;

  bool better_than(const Quality& other) const {
    // Beyond a roundness of 0.1 fewer patches are worth more than rounder ones.
    const double a = std::min(worst, 0.1), b = std::min(other.worst, 0.1);
    return a != b ? a > b : patches < other.patches;
  }
};

Quality quality(const std::vector<Polygon>& pieces) {
  Quality result;
  for (const Polygon& piece : pieces)
    for (const Polygon& patch : triangles_and_quads(piece)) {
      result.worst = std::min(result.worst, roundness(patch));
      ++result.patches;
    }
  return result;
}

/// Cuts along the edges of the cover one after another, keeping what is outside of each.
std::vector<Polygon> peel(Polygon rest, const Polygon& cover, const Vector3& normal, double tolerance,
                          std::size_t first, bool backwards) {
  std::vector<Polygon> pieces;
  const std::size_t n = cover.size();
  for (std::size_t step = 0; step < n && !rest.empty(); ++step) {
    const std::size_t k = (first + (backwards ? n - step : step)) % n;
    auto [inside, outside] = split(rest, cover[k], next_corner(cover, k), normal, tolerance);
    if (!outside.empty()) pieces.push_back(std::move(outside));
    rest = std::move(inside);
  }
  return pieces;
}

bool is_inside(const Vector3& point, const Polygon& triangle, const Vector3& normal, double tolerance) {
  for (std::size_t k = 0; k < triangle.size(); ++k)
    if (left_of(point, triangle[k], next_corner(triangle, k), normal) < -tolerance) return false;
  return true;
}

}  // namespace

Vector3 area_vector(const Polygon& polygon) {
  Vector3 doubled = Vector3::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    doubled += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
  return 0.5 * doubled;
}

bool is_convex(const Polygon& polygon, const Vector3& normal, double tolerance) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    for (const Vector3& point : polygon)
      if (left_of(point, polygon[k], next_corner(polygon, k), normal) < -tolerance) return false;
  return true;
}

bool contains(const Polygon& polygon, const Vector3& point, const Vector3& normal, double tolerance) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    if (edge.cross(point - polygon[k]).dot(normal) < -tolerance * edge.squaredNorm()) return false;
  }
  return true;
}

std::pair<Polygon, Polygon> split(const Polygon& polygon, const Vector3& from, const Vector3& to,
                                  const Vector3& normal, double tolerance) {
  const Vector3 left_direction = normal.cross(to - from).normalized();
  std::vector<double> distance;
  double lowest = 0, highest = 0;
  for (const Vector3& point : polygon) {
    const double d = left_direction.dot(point - from);
    distance.push_back(std::abs(d) <= tolerance ? 0.0 : d);
    lowest = std::min(lowest, distance.back());
    highest = std::max(highest, distance.back());
  }
  if (lowest == 0) return {highest > 0 ? polygon : Polygon{}, {}};
  if (highest == 0) return {{}, polygon};
  Polygon left, right;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (distance[k] >= 0) left.push_back(polygon[k]);
    if (distance[k] <= 0) right.push_back(polygon[k]);
    if (distance[k] * distance[next] < 0) {
      const double t = distance[k] / (distance[k] - distance[next]);
      const Vector3 crossing = polygon[k] + t * (polygon[next] - polygon[k]);
      left.push_back(crossing);
      right.push_back(crossing);
    }
  }
  return {left, right};
}

bool overlap(const Polygon& a, const Polygon& b, const Vector3& normal, double tolerance) {
  const auto separates = [&](const Polygon& edges, const Polygon& points) {
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (std::all_of(points.begin(), points.end(), [&](const Vector3& point) {
            return left_of(point, edges[k], next_corner(edges, k), normal) <= tolerance;
          }))
        return true;
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon, const Vector3& normal,
                                                    double tolerance) {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::size_t> rest(polygon.size());
  std::iota(rest.begin(), rest.end(), std::size_t{0});
  while (rest.size() > 3) {
    const std::size_t n = rest.size();
    std::size_t best = n;
    double best_roundness = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::array<std::size_t, 3> corners = {rest[(k + n - 1) % n], rest[k], rest[(k + 1) % n]};
      const Polygon ear = {polygon[corners[0]], polygon[corners[1]], polygon[corners[2]]};
      if (area_vector(ear).dot(normal) <= 0 || roundness(ear) <= best_roundness) continue;
      const bool blocked = std::any_of(rest.begin(), rest.end(), [&](std::size_t other) {
        return std::find(corners.begin(), corners.end(), other) == corners.end() &&
               is_inside(polygon[other], ear, normal, tolerance);
      });
      if (blocked) continue;
      best = k;
      best_roundness = roundness(ear);
    }
    if (best == n) return {};
    triangles.push_back({rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  if (rest.size() == 3) triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

std::vector<Polygon> convex_parts(const Polygon& polygon, const Vector3& normal, double tolerance) {
  if (is_convex(polygon, normal, tolerance)) return {polygon};
  std::vector<Polygon> parts;
  for (const auto& [a, b, c] : triangulate(polygon, normal, tolerance))
    parts.push_back({polygon[a], polygon[b], polygon[c]});
  return parts;
}

std::vector<Polygon> subtract(const Polygon& polygon, const Polygon& cover, const Vector3& normal,
                              double tolerance) {
  if (!overlap(polygon, cover, normal, tolerance)) return {polygon};
  std::vector<Polygon> best;
  Quality best_quality;
  for (const bool backwards : {false, true})
    for (std::size_t first = 0; first < cover.size(); ++first) {
      std::vector<Polygon> pieces = peel(polygon, cover, normal, tolerance, first, backwards);
      if (pieces.empty()) return {};
      const Quality found = quality(pieces);
      if (!best.empty() && !found.better_than(best_quality)) continue;
      best = std::move(pieces);
      best_quality = found;
    }
  return best;
}

std::vector<Polygon> triangles_and_quads(const Polygon& polygon) {
  std::vector<Polygon> result;
  Polygon rest = polygon;
  while (rest.size() > 4) {
    std::pair<Polygon, Polygon> best;
    double best_roundness = -1;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      std::pair<Polygon, Polygon> cut = cut_off_quad(rest, k);
      const double worst = std::min(roundness(cut.first), roundness(cut.second));
      if (worst <= best_roundness) continue;
      best = std::move(cut);
      best_roundness = worst;
    }
    result.push_back(std::move(best.first));
    rest = std::move(best.second);
  }
  if (rest.size() >= 3) result.push_back(std::move(rest));
  return result;
}

}  // namespace radiosity
