#include "form_factors/pair_sampler.hpp"

#include "foundation/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

void store(const Eigen::Vector3d& v, float* target) {
  for (int axis = 0; axis < 3; ++axis) target[axis] = static_cast<float>(v[axis]);
}

// 24 bits, so that the result stays below 1.
float to_fraction(std::uint32_t bits) {
  return static_cast<float>(bits >> 8U) * 0x1.0p-24F;
}

}  // namespace

PairSampler::PairSampler(const PatchGeometry& geometry) : loops_(vector_loops(best_instruction_set())) {
  for (int d = 0; d < SobolPoints::dimensions; ++d)
    for (std::uint32_t l = 0; l < 16; ++l) net_.low[d][l] = sobol_(d, l);
  charts_.reserve(static_cast<std::size_t>(geometry.patch_count()));
  for (int i = 0; i < geometry.patch_count(); ++i) {
    charts_.push_back(make_chart(geometry.polygon(i), geometry.plane(i)));
    stand_off_.push_back(stand_off(geometry.polygon(i)));
  }
}

double PairSampler::stand_off(const ConvexPolygon& polygon) {
  constexpr double rounding = 0x1p-21;
  double farthest = 0, extent = 0;
  for (int k = 0; k < polygon.corner_count(); ++k) {
    farthest = std::max(farthest, polygon[k].cwiseAbs().maxCoeff());
    extent = std::max(extent, (polygon[k] - polygon[0]).norm());
  }
  return std::min(most_stand_off, std::max(0.01 * extent, rounding * farthest));
}

PatchChart PairSampler::make_chart(const ConvexPolygon& p, const Plane& plane) const {
  PatchChart chart{};
  chart.triangle = p.corner_count() == 3 ? 1 : 0;
  const Eigen::Vector3d a = p[1] - p[0];
  Eigen::Vector3d b = Eigen::Vector3d::Zero(), d = p[2] - p[1];
  chart.jacobian = 1;
  if (!chart.triangle) {
    b = p[3] - p[0];
    d -= p[3] - p[0];
    const double area = p.area_vector().norm();
    chart.jacobian = static_cast<float>(plane.normal.dot(a.cross(b)) / area);
    chart.slope_u = static_cast<float>(plane.normal.dot(a.cross(d)) / area);
    chart.slope_v = static_cast<float>(plane.normal.dot(d.cross(b)) / area);
  }
  store(p[0] + stand_off(p) * plane.normal, chart.corner);
  store(a, chart.a);
  store(b, chart.b);
  store(d, chart.d);
  store(plane.normal, chart.normal);
  return chart;
}

PairSampler::Shift PairSampler::shifted(std::uint32_t k, const Shift& shift) const {
  Shift high;
  for (int d = 0; d < SobolPoints::dimensions; ++d)
    high[static_cast<std::size_t>(d)] = sobol_(d, 16 * k) ^ shift[static_cast<std::size_t>(d)];
  return high;
}

void PairSampler::fill_hemisphere(int i, std::uint32_t k, const Shift& shift, RayPacket& packet) const {
  const PatchChart& chart = charts_[static_cast<std::size_t>(i)];
  const Shift high = shifted(k, shift);
  float weight[RayPacket::size];
  loops_.fill(chart, chart, net_, high.data(), packet, weight);  // for the origins
  const Eigen::Vector3f normal(chart.normal[0], chart.normal[1], chart.normal[2]);
  const Eigen::Vector3f s = normal.unitOrthogonal(), t = normal.cross(s);
  for (std::size_t l = 0; l < 16; ++l) {
    const float u = to_fraction(net_.low[2][l] ^ high[2]);
    const float angle = 2 * std::numbers::pi_v<float> * to_fraction(net_.low[3][l] ^ high[3]);
    const float radius = std::sqrt(u), height = std::sqrt(1 - u);
    const Eigen::Vector3f d = radius * std::cos(angle) * s + radius * std::sin(angle) * t + height * normal;
    packet.target_x[l] = packet.origin_x[l] + d.x();
    packet.target_y[l] = packet.origin_y[l] + d.y();
    packet.target_z[l] = packet.origin_z[l] + d.z();
    packet.active[l] = height > 1e-4F ? -1 : 0;
  }
}

PairSampler::Shift PairSampler::random_shift(std::uint64_t seed, std::uint64_t stream) {
  RandomStream random(seed, stream);
  const std::uint64_t first = random(), second = random();
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32U),
          static_cast<std::uint32_t>(second), static_cast<std::uint32_t>(second >> 32U)};
}

}  // namespace radiosity
