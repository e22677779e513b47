#include "form_factors/pair_sampler.hpp"

#include "foundation/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

std::array<float, 3> to_floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// 24 bits, so that the result stays below 1.
float to_fraction(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1.0p-24F; }

}  // namespace

PairSampler::PairSampler(const PatchGeometry& geometry) {
  for (int d = 0; d < SobolPoints::dimensions; ++d)
    for (std::uint32_t l = 0; l < 16; ++l) net_[static_cast<std::size_t>(d)][l] = sobol_(d, l);
  charts_.reserve(static_cast<std::size_t>(geometry.patch_count()));
  for (int i = 0; i < geometry.patch_count(); ++i) charts_.push_back(make_chart(geometry.polygon(i), geometry.plane(i)));
}

PairSampler::Chart PairSampler::make_chart(const ConvexPolygon& p, const Plane& plane) const {
  Chart chart{};
  chart.triangle = p.corner_count() == 3;
  const Eigen::Vector3d a = p[1] - p[0];
  const Eigen::Vector3d b = chart.triangle ? Eigen::Vector3d::Zero().eval() : (p[3] - p[0]).eval();
  const Eigen::Vector3d d = chart.triangle ? (p[2] - p[1]).eval() : (p[2] - p[1] - p[3] + p[0]).eval();
  chart.corner = to_floats(p[0] + static_cast<double>(stand_off) * plane.normal);
  chart.a = to_floats(a), chart.b = to_floats(b), chart.d = to_floats(d), chart.normal = to_floats(plane.normal);
  chart.jacobian = 1;
  if (!chart.triangle) {
    const double unit = p.area_vector().norm();
    chart.jacobian = static_cast<float>(plane.normal.dot(a.cross(b)) / unit);
    chart.slope_u = static_cast<float>(plane.normal.dot(a.cross(d)) / unit);
    chart.slope_v = static_cast<float>(plane.normal.dot(d.cross(b)) / unit);
  }
  return chart;
}

void PairSampler::place(const Chart& chart, int dimension, std::uint32_t k, const Shift& shift, float* x, float* y,
                        float* z, float* density) const {
  const auto first = static_cast<std::size_t>(dimension), second = first + 1;
  const std::uint32_t high_u = sobol_(dimension, 16 * k) ^ shift[first];
  const std::uint32_t high_v = sobol_(dimension + 1, 16 * k) ^ shift[second];
  for (std::size_t l = 0; l < 16; ++l) {
    float u = to_fraction(net_[first][l] ^ high_u);
    const float v = to_fraction(net_[second][l] ^ high_v);
    if (chart.triangle) u = std::sqrt(u);
    const float uv = u * v;
    x[l] = chart.corner[0] + u * chart.a[0] + v * chart.b[0] + uv * chart.d[0];
    y[l] = chart.corner[1] + u * chart.a[1] + v * chart.b[1] + uv * chart.d[1];
    z[l] = chart.corner[2] + u * chart.a[2] + v * chart.b[2] + uv * chart.d[2];
    density[l] = chart.jacobian + u * chart.slope_u + v * chart.slope_v;
  }
}

void PairSampler::fill(int i, int j, std::uint32_t k, const Shift& shift, RayPacket& packet,
                       std::array<float, 16>& weight) const {
  const Chart& from = charts_[static_cast<std::size_t>(i)];
  const Chart& to = charts_[static_cast<std::size_t>(j)];
  std::array<float, 16> density_from, density_to;
  place(from, 0, k, shift, packet.origin_x, packet.origin_y, packet.origin_z, density_from.data());
  place(to, 2, k, shift, packet.target_x, packet.target_y, packet.target_z, density_to.data());
  for (std::size_t l = 0; l < 16; ++l) {
    const float dx = packet.target_x[l] - packet.origin_x[l];
    const float dy = packet.target_y[l] - packet.origin_y[l];
    const float dz = packet.target_z[l] - packet.origin_z[l];
    const float square = dx * dx + dy * dy + dz * dz;
    const float leaving = std::max(0.0F, from.normal[0] * dx + from.normal[1] * dy + from.normal[2] * dz);
    const float arriving = std::max(0.0F, -(to.normal[0] * dx + to.normal[1] * dy + to.normal[2] * dz));
    const float both = leaving * arriving;
    weight[l] = both > 0 ? density_from[l] * density_to[l] * both / (square * square) : 0.0F;
    packet.active[l] = both > 0 ? -1 : 0;
  }
}

void PairSampler::fill_hemisphere(int i, std::uint32_t k, const Shift& shift, RayPacket& packet) const {
  const Chart& chart = charts_[static_cast<std::size_t>(i)];
  std::array<float, 16> density;
  place(chart, 0, k, shift, packet.origin_x, packet.origin_y, packet.origin_z, density.data());
  const Eigen::Vector3f normal(chart.normal[0], chart.normal[1], chart.normal[2]);
  const Eigen::Vector3f s = normal.unitOrthogonal(), t = normal.cross(s);
  const std::uint32_t high_u = sobol_(2, 16 * k) ^ shift[2], high_v = sobol_(3, 16 * k) ^ shift[3];
  for (std::size_t l = 0; l < 16; ++l) {
    const float u = to_fraction(net_[2][l] ^ high_u);
    const float angle = 2 * std::numbers::pi_v<float> * to_fraction(net_[3][l] ^ high_v);
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
