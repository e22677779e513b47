#include "form_factors/quadrature_points.hpp"

#include "form_factors/gauss_legendre.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

using Eigen::Vector3d;

struct WeightedPoint {
  Vector3d position;
  double weight;
};

std::vector<WeightedPoint> quad_points(const ConvexPolygon& quad, int m) {
  const GaussLegendre rule(m);
  std::vector<WeightedPoint> points;
  for (int a = 0; a < m; ++a) {
    for (int b = 0; b < m; ++b) {
      const double u = 0.5 * (1 + rule.node[static_cast<std::size_t>(a)]);
      const double v = 0.5 * (1 + rule.node[static_cast<std::size_t>(b)]);
      const Vector3d along_u = (1 - v) * (quad[1] - quad[0]) + v * (quad[2] - quad[3]);
      const Vector3d along_v = (1 - u) * (quad[3] - quad[0]) + u * (quad[2] - quad[1]);
      const double weight =
          0.25 * rule.weight[static_cast<std::size_t>(a)] * rule.weight[static_cast<std::size_t>(b)];
      points.push_back(
          {(1 - u) * (1 - v) * quad[0] + u * (1 - v) * quad[1] + u * v * quad[2] + (1 - u) * v * quad[3],
           weight * along_u.cross(along_v).norm()});
    }
  }
  return points;
}

// Symmetric rules of degree 4, 6 and 8 by D. A. Dunavant, "High degree efficient symmetrical Gaussian
// quadrature rules for the triangle", 1985: orbits of barycentric coordinates (a, b, 1 - a - b) with the
// weight of each point.
struct Orbit {
  int size;  // 1, 3 (a = b) or 6
  double a, b, weight;
};

const std::vector<Orbit>& triangle_rule(int order) {
  static const std::array<std::vector<Orbit>, QuadraturePoints::orders> rules = {{
      {{3, .445948490915965, .445948490915965, .223381589678011},
       {3, .091576213509771, .091576213509771, .109951743655322}},
      {{3, .249286745170910, .249286745170910, .116786275726379},
       {3, .063089014491502, .063089014491502, .050844906370207},
       {6, .310352451033784, .636502499121399, .082851075618374}},
      {{1, 1. / 3, 1. / 3, .144315607677787},
       {3, .459292588292723, .459292588292723, .095091634267285},
       {3, .170569307751760, .170569307751760, .103217370534718},
       {3, .050547228317031, .050547228317031, .032458497623198},
       {6, .263112829634638, .728492392955404, .027230314174435}},
  }};
  return rules[static_cast<std::size_t>(order)];
}

std::vector<WeightedPoint> triangle_points(const ConvexPolygon& triangle, int order) {
  const double area = triangle.area_vector().norm();
  std::vector<WeightedPoint> points;
  const auto add = [&](double a, double b, double c, double weight) {
    points.push_back({a * triangle[0] + b * triangle[1] + c * triangle[2], weight * area});
  };
  double total = 0;
  for (const Orbit& orbit : triangle_rule(order)) total += orbit.size * orbit.weight;
  for (const Orbit& orbit : triangle_rule(order)) {
    const double a = orbit.a, b = orbit.b, c = 1 - orbit.a - orbit.b, weight = orbit.weight / total;
    add(a, b, c, weight);
    if (orbit.size >= 3) add(b, c, a, weight), add(c, a, b, weight);
    if (orbit.size == 6) add(b, a, c, weight), add(a, c, b, weight), add(c, b, a, weight);
  }
  return points;
}

std::vector<WeightedPoint> points_of(const ConvexPolygon& polygon, int order) {
  return polygon.corner_count() == 3 ? triangle_points(polygon, order) : quad_points(polygon, order + 2);
}

}  // namespace

QuadraturePoints::QuadraturePoints(std::span<const ConvexPolygon> polygons, std::span<const Plane> planes)
    : loops_(vector_loops(best_instruction_set())) {
  const auto n = polygons.size();
  std::array<int, orders> most{};
  point_count_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int order = 0; order < orders; ++order) {
      const int m = order + 2;
      constexpr std::array<int, orders> triangle_counts = {6, 12, 16};
      const auto o = static_cast<std::size_t>(order);
      point_count_[i][o] = polygons[i].corner_count() == 3 ? triangle_counts[o] : m * m;
      most[o] = std::max(most[o], point_count_[i][o]);
    }
  std::size_t total = 19 * n;
  for (const int points : most) total += 4 * static_cast<std::size_t>(points) * n;
  storage_.assign(total, 0.0);

  double* at = storage_.data();
  const auto reserve = [&](std::size_t count) {
    double* const start = at;
    at += count;
    return start;
  };
  const auto fill = [&](auto&& value) {
    double* const start = reserve(n);
    for (std::size_t i = 0; i < n; ++i) start[i] = value(i);
    return start;
  };
  for (int k = 0; k < 4; ++k) {
    const auto corner = [&, k](std::size_t i) -> const Vector3d& {
      return polygons[i][std::min(k, polygons[i].corner_count() - 1)];
    };
    arrays_.corner_x[k] = fill([&](std::size_t i) { return corner(i).x(); });
    arrays_.corner_y[k] = fill([&](std::size_t i) { return corner(i).y(); });
    arrays_.corner_z[k] = fill([&](std::size_t i) { return corner(i).z(); });
  }
  arrays_.normal_x = fill([&](std::size_t i) { return planes[i].normal.x(); });
  arrays_.normal_y = fill([&](std::size_t i) { return planes[i].normal.y(); });
  arrays_.normal_z = fill([&](std::size_t i) { return planes[i].normal.z(); });
  arrays_.offset = fill([&](std::size_t i) { return planes[i].offset; });
  const auto center = [&](std::size_t i) -> Vector3d {
    Vector3d sum = Vector3d::Zero();
    for (int k = 0; k < polygons[i].corner_count(); ++k) sum += polygons[i][k];
    return sum / polygons[i].corner_count();
  };
  arrays_.center_x = fill([&](std::size_t i) { return center(i).x(); });
  arrays_.center_y = fill([&](std::size_t i) { return center(i).y(); });
  arrays_.center_z = fill([&](std::size_t i) { return center(i).z(); });

  for (int order = 0; order < orders; ++order) {
    const auto o = static_cast<std::size_t>(order);
    const std::size_t block = static_cast<std::size_t>(most[o]) * n;
    double* const x = reserve(block);
    double* const y = reserve(block);
    double* const z = reserve(block);
    double* const weight = reserve(block);
    for (std::size_t i = 0; i < n; ++i) {
      const auto points = points_of(polygons[i], order);
      for (std::size_t q = 0; q < points.size(); ++q) {
        x[q * n + i] = points[q].position.x();
        y[q * n + i] = points[q].position.y();
        z[q * n + i] = points[q].position.z();
        weight[q * n + i] = points[q].weight;
      }
    }
    points_[o] = {x, y, z, weight, static_cast<int>(n)};
  }
}

double QuadraturePoints::least_ratio(int order, double tolerance, bool triangles) {
  // error <= factor * ratio^-power, with the factor doubled for patches less regular than those of the fit
  struct Fit {
    double factor, power;
  };
  constexpr std::array<Fit, orders> quads = {{{0.4, 4}, {0.05, 6}, {0.01, 8}}};
  constexpr std::array<Fit, orders> with_triangles = {{{0.06, 5}, {0.008, 7}, {0.016, 9}}};
  const auto o = static_cast<std::size_t>(order);
  const double for_quads = std::pow(quads[o].factor / tolerance, 1 / quads[o].power);
  const double for_triangles = std::pow(with_triangles[o].factor / tolerance, 1 / with_triangles[o].power);
  return std::max(2.5, triangles ? std::max(for_quads, for_triangles) : for_quads);
}

void QuadraturePoints::classify(int i, int begin, int end, PairHeights& heights) const {
  loops_.classify(arrays_, i, begin, end, heights);
}

void QuadraturePoints::exchange(int own_order, int other_order, int i, int begin, int end,
                                double* exchange) const {
  const auto own = static_cast<std::size_t>(own_order), other = static_cast<std::size_t>(other_order);
  loops_.exchange(arrays_, points_[own], point_count_[static_cast<std::size_t>(i)][own], points_[other],
                  point_count_[static_cast<std::size_t>(begin)][other], i, begin, end, exchange);
}

}  // namespace radiosity
