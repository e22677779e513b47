#pragma once

#include "form_factors/patch_geometry.hpp"
#include "form_factors/ray_packet.hpp"
#include "form_factors/sobol_points.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace radiosity {

/// Where rays of one pair of patches start and end: points spread over both patches by a randomly shifted Sobol
/// sequence, sixteen at a time, with the weight cos cos / r^4 (times the Jacobians) of each segment.
class PairSampler {
 public:
  explicit PairSampler(const PatchGeometry& geometry);

  /// How far points stand off their surface, in lengths of the scaled scene: beyond float32 rounding, below any detail.
  static constexpr float stand_off = 3e-6F;

  using Shift = std::array<std::uint32_t, SobolPoints::dimensions>;

  /// Points 16 k ... 16 k + 15 of the shifted sequence for the pair (i, j). Weights of segments that leave or arrive
  /// behind a surface are 0, and those rays inactive.
  void fill(int i, int j, std::uint32_t k, const Shift& shift, RayPacket& packet, std::array<float, 16>& weight) const;

  /// Sixteen cosine-distributed rays from patch i: packet.target is one unit away along the ray.
  void fill_hemisphere(int i, std::uint32_t k, const Shift& shift, RayPacket& packet) const;

  /// A shift that depends on nothing but its arguments.
  static Shift random_shift(std::uint64_t seed, std::uint64_t stream);

 private:
  // x(u, v) = corner + u a + v b + u v d, density |a + v d, b + u d| = jacobian + u slope_u + v slope_v;
  // a triangle takes u -> sqrt(u) and b = 0.
  struct Chart {
    std::array<float, 3> corner, a, b, d, normal;
    float jacobian, slope_u, slope_v;
    bool triangle;
  };
  Chart make_chart(const ConvexPolygon& polygon, const Plane& plane) const;
  void place(const Chart& chart, int dimension, std::uint32_t k, const Shift& shift, float* x, float* y, float* z,
             float* density) const;

  SobolPoints sobol_;
  std::array<std::array<std::uint32_t, 16>, SobolPoints::dimensions> net_{};
  std::vector<Chart> charts_;
};

}  // namespace radiosity
