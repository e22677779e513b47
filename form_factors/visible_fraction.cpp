#include "form_factors/visible_fraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

constexpr std::size_t kReplicates = 4;

struct Tally {
  double visible = 0;  // sum of the weights of unblocked rays
  double all = 0;
};

double standard_variance(const std::array<Tally, kReplicates>& tallies, double fraction, double rays) {
  double spread = 0;
  for (const Tally& tally : tallies) {
    const double difference = (tally.all > 0 ? tally.visible / tally.all : fraction) - fraction;
    spread += difference * difference;
  }
  spread /= static_cast<double>(kReplicates * (kReplicates - 1));
  if (fraction <= 0 || fraction >= 1) {
    const double doubt = 1 / (rays + 2);
    return doubt * (1 - doubt) / rays;
  }
  // Four replicates can agree by chance: never below what a Sobol sequence does to a plain binomial variance.
  const double binomial = fraction * (1 - fraction) / rays;
  return std::max(spread, 0.25 * binomial / std::sqrt(std::sqrt(rays / 16)));
}

}  // namespace

VisibilitySampling::VisibilitySampling(const PatchGeometry& geometry, const Occluders& occluders,
                                       std::uint64_t seed, std::uint64_t least_rays)
    : geometry_(geometry), occluders_(occluders), sampler_(geometry), seed_(seed), least_rays_(least_rays) {}

VisibleFraction VisibilitySampling::operator()(int i, int j, double wanted,
                                               std::vector<RayPacket>* record) const {
  const auto [first, second] = sampler_.ends(i, j);
  const auto stream = static_cast<std::uint64_t>(geometry_.to_mesh(std::min(i, j))) << 32U |
                      static_cast<std::uint64_t>(geometry_.to_mesh(std::max(i, j)));
  std::array<PairSampler::Shift, kReplicates> shifts;
  for (std::size_t r = 0; r < kReplicates; ++r)
    shifts[r] = PairSampler::random_shift(seed_ + 0x51ed2701ULL * r, stream);

  std::array<Tally, kReplicates> tallies;
  VisibleFraction fraction;
  RayPacket packet;
  alignas(64) float weight[RayPacket::size];
  std::uint32_t done = 0, goal = static_cast<std::uint32_t>(least_rays_ / (16 * kReplicates));
  while (true) {
    for (; done < goal; ++done) {
      for (std::size_t r = 0; r < kReplicates; ++r) {
        sampler_.fill(first, second, done, shifts[r], packet, weight);
        occluders_.trace(packet);
        if (record) record->push_back(packet);
        sampler_.tally(packet, weight, tallies[r].visible, tallies[r].all);
      }
    }
    fraction.rays = std::uint64_t{16} * kReplicates * done;
    double visible = 0, all = 0;
    for (const Tally& tally : tallies) visible += tally.visible, all += tally.all;
    fraction.value = all > 0 ? visible / all : 1;
    fraction.variance =
        all > 0 ? standard_variance(tallies, fraction.value, static_cast<double>(fraction.rays)) : 0.25;
    if (fraction.variance <= wanted * wanted || fraction.rays >= most_rays) return fraction;
    goal *= 2;
  }
}

}  // namespace radiosity
