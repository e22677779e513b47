#pragma once

#include "form_factors/patch_geometry.hpp"
#include "form_factors/ray_packet.hpp"
#include "form_factors/sobol_points.hpp"
#include "form_factors/vector_loops.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiosity {

/// Where rays of one pair of patches start and end: points spread over both patches by a randomly shifted
/// Sobol sequence, sixteen at a time, with the weight cos cos / r^4 (times the Jacobians) of each segment.
class PairSampler {
 public:
  explicit PairSampler(const PatchGeometry& geometry);

  /// How far points stand off their surface, in lengths of the scaled scene: beyond float32 rounding, below
  /// any detail. Patches that are tiny beside the scene have details as tiny around them: a hundredth of
  /// their size, or rounding where they are, if that is less.
  static constexpr double most_stand_off = 3e-6;
  static double stand_off(const ConvexPolygon& polygon);

  /// Which of two patches rays start from, and the other: the one that stands off less, since the start of a
  /// ray is more certain than its end.
  std::pair<int, int> ends(int i, int j) const {
    const auto off = [&](int patch) { return stand_off_[static_cast<std::size_t>(patch)]; };
    const int first = std::min(i, j), second = std::max(i, j);
    return off(second) < off(first) ? std::pair(second, first) : std::pair(first, second);
  }

  using Shift = std::array<std::uint32_t, SobolPoints::dimensions>;

  /// Points 16 k ... 16 k + 15 of the shifted sequence for the pair (i, j). Weights of segments that leave or
  /// arrive behind a surface are 0, and those rays inactive.
  void fill(int i, int j, std::uint32_t k, const Shift& shift, RayPacket& packet, float* weight) const {
    const Shift high = shifted(k, shift);
    loops_.fill(charts_[static_cast<std::size_t>(i)], charts_[static_cast<std::size_t>(j)], net_, high.data(),
                packet, weight);
  }

  /// Adds the weights of the packet's rays, and of those that were not blocked, to two sums.
  void tally(const RayPacket& packet, const float* weight, double& visible, double& all) const {
    loops_.tally(packet, weight, &visible, &all);
  }

  /// Sixteen cosine-distributed rays from patch i: packet.target is one unit away along the ray.
  void fill_hemisphere(int i, std::uint32_t k, const Shift& shift, RayPacket& packet) const;

  /// A shift that depends on nothing but its arguments.
  static Shift random_shift(std::uint64_t seed, std::uint64_t stream);

 private:
  Shift shifted(std::uint32_t k, const Shift& shift) const;
  PatchChart make_chart(const ConvexPolygon& polygon, const Plane& plane) const;

  VectorLoops loops_;
  SobolPoints sobol_;
  SobolNet net_{};
  std::vector<PatchChart> charts_;
  std::vector<double> stand_off_;
};

}  // namespace radiosity
