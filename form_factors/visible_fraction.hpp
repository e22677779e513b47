#pragma once

#include "form_factors/occluders.hpp"
#include "form_factors/pair_sampler.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

/// How much of the exchange between two patches gets through, 0 <= value <= 1.
struct VisibleFraction {
  double value = 1;
  double variance = 0;  ///< of value, estimated; 0 where it is proved
  std::uint64_t rays = 0;
};

/// Samples pairs until the estimated standard error is small enough.
///
/// Four independent shifts of one Sobol sequence run side by side; their spread is the error estimate. Where
/// all rays agree, the estimate is that of (hits + 1) / (rays + 2), so that a small hole is not taken for
/// none before enough rays say so.
class VisibilitySampling {
 public:
  /// `least_rays`: a multiple of 64 that every pair gets.
  VisibilitySampling(const PatchGeometry& geometry, const Occluders& occluders, std::uint64_t seed,
                     std::uint64_t least_rays = usual_least_rays);

  /// At least the least rays, at most most_rays; stops once the standard error is <= wanted. Depends on (i,
  /// j) and the seed alone. `record`, if not null, receives a copy of every packet (for measuring the ray
  /// tracer alone).
  VisibleFraction operator()(int i, int j, double wanted, std::vector<RayPacket>* record = nullptr) const;

  static constexpr std::uint64_t usual_least_rays = 256;
  static constexpr std::uint64_t most_rays = std::uint64_t{1} << 20U;

 private:
  const PatchGeometry& geometry_;
  const Occluders& occluders_;
  PairSampler sampler_;
  std::uint64_t seed_;
  std::uint64_t least_rays_;
};

}  // namespace radiosity
