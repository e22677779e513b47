#include "form_factors/exposure.hpp"

#include "form_factors/pair_sampler.hpp"
#include "foundation/parallel.hpp"

#include <array>
#include <atomic>
#include <vector>

namespace radiosity {
namespace {

struct Count {
  std::uint64_t rays = 0, fronts = 0, backs = 0, gone = 0;
};

void probe(int patch, std::uint32_t begin, std::uint32_t end, const PairSampler& sampler,
           const Occluders& occluders, const PairSampler::Shift& shift, Count& count) {
  RayPacket packet;
  std::array<RayHit, RayPacket::size> hits;
  for (std::uint32_t k = begin; k < end; ++k) {
    sampler.fill_hemisphere(patch, k, shift, packet);
    occluders.first_hits(packet, hits.data());
    for (std::size_t l = 0; l < RayPacket::size; ++l) {
      if (!packet.active[l]) continue;
      ++count.rays;
      if (hits[l].face < 0)
        ++count.gone;
      else
        ++(hits[l].front ? count.fronts : count.backs);
    }
  }
}

}  // namespace

Exposure measure_exposure(const PatchMesh& mesh, const PatchGeometry& geometry, const Occluders& occluders,
                          std::uint64_t seed, Monitor& monitor) {
  const Index n = mesh.patch_count();
  Exposure exposure;
  exposure.exposed = Eigen::VectorXd::Ones(n);
  const bool enclosure = mesh.topology.enclosure;
  if (enclosure && mesh.topology.convex) return exposure;

  constexpr std::uint32_t few_packets = 16, many_packets = 256;
  const PairSampler sampler(geometry);
  std::vector<Count> counts(static_cast<std::size_t>(n));
  std::atomic<std::size_t> done{0};
  parallel_for(counts.size(), [&](std::size_t i) {
    const auto patch = static_cast<int>(i);
    const auto shift = PairSampler::random_shift(seed ^ 0x70726f6265ULL,
                                                 static_cast<std::uint64_t>(geometry.to_mesh(patch)));
    Count& count = counts[i];
    probe(patch, 0, few_packets, sampler, occluders, shift, count);
    const bool all_arrived = count.backs == 0 && (count.gone == 0 || enclosure);
    if (!all_arrived) probe(patch, few_packets, many_packets, sampler, occluders, shift, count);
    const std::uint64_t arrived = count.fronts + (enclosure ? count.gone : 0);
    exposure.exposed[geometry.to_mesh(patch)] =
        static_cast<double>(arrived) / static_cast<double>(count.rays);
    if (++done % 256 == 0)
      monitor.checkpoint("probing exposure", static_cast<double>(done) / static_cast<double>(n));
  });
  for (const Count& count : counts) {
    exposure.probe_rays += count.rays;
    exposure.back_hits += count.backs;
    if (enclosure) exposure.leaks += count.gone;
  }
  return exposure;
}

}  // namespace radiosity
