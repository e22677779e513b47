#include "form_factors/edge_integral.hpp"

#include "form_factors/gauss_legendre.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

using Eigen::Vector3d;

double x_log_abs(double x) {
  return x == 0 ? 0 : x * std::log(std::abs(x));
}

// The integral of ln |p - b(t)| over an edge b of unit direction v and the given length.
double point_edge_integral(const Vector3d& p, const Vector3d& b0, const Vector3d& v, double length) {
  const Vector3d w = p - b0;
  const double foot = w.dot(v);
  const double height_squared = w.cross(v).squaredNorm();
  const double low = -foot, high = length - foot;
  if (height_squared < 1e-30) return x_log_abs(high) - high - x_log_abs(low) + low;
  const double height = std::sqrt(height_squared);
  const double angle = std::atan2(height * (high - low), height_squared + low * high);
  return 0.5 * high * std::log(high * high + height_squared) -
         0.5 * low * std::log(low * low + height_squared) - (high - low) + height * angle;
}

// Second antiderivative in z of ln sqrt(z^2 + h^2).
double parallel_antiderivative(double z, double h) {
  const double square = z * z + h * h;
  if (square < 1e-30) return 0;
  const double logarithm = 0.25 * (z * z - h * h) * std::log(square) - 0.75 * z * z;
  return h == 0 ? logarithm : logarithm + h * z * std::atan(z / h);
}

double parallel_edges(const Vector3d& a0, double a_length, const Vector3d& b0, double b_length,
                      const Vector3d& u, double cosine) {
  const Vector3d w = b0 - a0;
  const double h = w.cross(u).norm();
  const double start = w.dot(u), end = start + (cosine > 0 ? b_length : -b_length);
  const double low = std::min(start, end), high = std::max(start, end);
  const double distance = h < 1e-14 ? 0 : h;
  return parallel_antiderivative(a_length - low, distance) + parallel_antiderivative(-high, distance) -
         parallel_antiderivative(a_length - high, distance) - parallel_antiderivative(-low, distance);
}

// Edges whose carrier lines meet: with the origin at the meeting point, ln r is a homogeneous function plus a
// constant, div((s, t) ln r) = 2 ln r + 1, and the divergence theorem leaves four single integrals.
double meeting_edges(const Vector3d& meeting, const Vector3d& u, double s0, double s1, const Vector3d& v,
                     double t0, double t1) {
  const auto over_b = [&](double s) {
    return point_edge_integral(meeting + s * u, meeting + t0 * v, v, t1 - t0);
  };
  const auto over_a = [&](double t) {
    return point_edge_integral(meeting + t * v, meeting + s0 * u, u, s1 - s0);
  };
  double sum = -(s1 - s0) * (t1 - t0);
  if (s1 != 0) sum += s1 * over_b(s1);
  if (s0 != 0) sum -= s0 * over_b(s0);
  if (t1 != 0) sum += t1 * over_a(t1);
  if (t0 != 0) sum -= t0 * over_a(t0);
  return 0.5 * sum;
}

// Two edges whose lines are skew: points a + s u and b + t v, nearest to each other at s = near with the
// distance gap.
struct SkewEdges {
  Vector3d a, u, b, v;
  double b_length;
  double near;
  double branch;  // gap / sine of the angle between the lines
};

// The inner integral as a function of complex s is analytic around `middle` up to the ends of b, seen from
// there, and, where the foot of s falls on b, up to near +- i branch, where the distance of the lines
// vanishes. Edges that run close along each other are therefore no trouble in between their ends.
double analytic_radius(const SkewEdges& edges, double middle) {
  const Vector3d p = edges.a + middle * edges.u - edges.b;
  const double foot = p.dot(edges.v);
  const double to_ends = std::min(p.norm(), (p - edges.b_length * edges.v).norm());
  const double to_branch = std::hypot(edges.near - middle, edges.branch);
  const bool on_edge = foot > -to_branch && foot < edges.b_length + to_branch;
  return on_edge ? std::min(to_ends, to_branch) : to_ends;
}

// Gauss-Legendre over a piece of the outer edge. With q = analytic radius / half length the error falls as
// (q + sqrt(q^2 - 1))^(-2 points); pieces with too small a q are halved.
double outer_quadrature(const SkewEdges& edges, double s0, double s1, double tolerance, int depth) {
  static const std::array<GaussLegendre, 5> rules = {GaussLegendre(4), GaussLegendre(6), GaussLegendre(8),
                                                     GaussLegendre(12), GaussLegendre(16)};
  const double half = 0.5 * (s1 - s0), middle = 0.5 * (s0 + s1);
  const double q = analytic_radius(edges, middle) / half;
  const GaussLegendre* rule = nullptr;
  if (q > 1.2) {
    const double log_rate = std::log(q + std::sqrt(q * q - 1));
    for (const GaussLegendre& candidate : rules)
      if (2 * log_rate * static_cast<double>(candidate.node.size()) > -std::log(tolerance)) {
        rule = &candidate;
        break;
      }
  }
  if (!rule && depth > 0)
    return outer_quadrature(edges, s0, middle, tolerance, depth - 1) +
           outer_quadrature(edges, middle, s1, tolerance, depth - 1);
  if (!rule) rule = &rules.back();
  double sum = 0;
  for (std::size_t k = 0; k < rule->node.size(); ++k)
    sum += rule->weight[k] * point_edge_integral(edges.a + (middle + half * rule->node[k]) * edges.u, edges.b,
                                                 edges.v, edges.b_length);
  return sum * half;
}

}  // namespace

double edge_log_integral(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1,
                         double tolerance) {
  const double a_length = (a1 - a0).norm(), b_length = (b1 - b0).norm();
  if (a_length == 0 || b_length == 0) return 0;
  const Vector3d u = (a1 - a0) / a_length, v = (b1 - b0) / b_length;
  const double cosine = u.dot(v);
  const Vector3d normal = u.cross(v);
  const double sine_squared = normal.squaredNorm();
  if (sine_squared < 1e-20) return parallel_edges(a0, a_length, b0, b_length, u, cosine);

  const Vector3d w = b0 - a0;
  const double gap = std::abs(w.dot(normal)) / std::sqrt(sine_squared);
  const double s = w.cross(v).dot(normal) / sine_squared;  // the lines are nearest at a0 + s u and b0 + t v
  const double t = w.cross(u).dot(normal) / sine_squared;
  if (gap < 1e-11 && sine_squared > 1e-12 && std::abs(s) < 1e3 && std::abs(t) < 1e3) {
    const auto snap = [](double x) { return std::abs(x) < 1e-14 ? 0 : x; };
    return meeting_edges(a0 + s * u, u, snap(-s), snap(a_length - s), v, snap(-t), snap(b_length - t));
  }
  const SkewEdges edges{a0, u, b0, v, b_length, s, gap / std::sqrt(sine_squared)};
  constexpr int most_halvings = 40;
  return outer_quadrature(edges, 0, a_length, tolerance, most_halvings);
}

}  // namespace radiosity
