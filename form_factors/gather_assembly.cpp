#include "form_factors/form_factor_methods.hpp"
#include "form_factors/pair_sampler.hpp"
#include "foundation/parallel.hpp"

#include <array>
#include <atomic>
#include <vector>

namespace radiosity {

GatheredFactors gather_form_factors(const PatchMesh& mesh, const PatchGeometry& geometry,
                                    std::uint32_t rays_per_patch, std::uint64_t seed, Monitor& monitor) {
  const auto n = static_cast<std::size_t>(geometry.patch_count());
  std::vector<ConvexPolygon> patches;
  for (std::size_t i = 0; i < n; ++i) patches.push_back(geometry.polygon(static_cast<int>(i)));
  const Occluders obstacles(patches);
  const PairSampler sampler(geometry);
  const std::uint32_t packets = (rays_per_patch + RayPacket::size - 1) / RayPacket::size;

  GatheredFactors result;
  result.factors = std::make_shared<RowMajorMatrix<double>>(mesh.patch_count(), mesh.patch_count());
  std::vector<std::uint64_t> rays(n, 0);
  std::atomic<std::size_t> done{0};
  parallel_for(n, [&](std::size_t i) {
    const Index row_number = geometry.to_mesh(static_cast<int>(i));
    const auto shift =
        PairSampler::random_shift(seed ^ 0x676174686572ULL, static_cast<std::uint64_t>(row_number));
    double* const row = result.factors->row(row_number);
    RayPacket packet;
    std::array<RayHit, RayPacket::size> hits;
    for (std::uint32_t k = 0; k < packets; ++k) {
      sampler.fill_hemisphere(static_cast<int>(i), k, shift, packet);
      obstacles.first_hits(packet, hits.data());
      for (std::size_t l = 0; l < RayPacket::size; ++l) {
        if (!packet.active[l]) continue;
        ++rays[i];
        if (hits[l].face >= 0 && hits[l].front) row[geometry.to_mesh(hits[l].face)] += 1;
      }
    }
    for (std::size_t j = 0; j < n; ++j) row[j] /= static_cast<double>(rays[i]);
    if (++done % 64 == 0)
      monitor.checkpoint("form factors (gather)", static_cast<double>(done) / static_cast<double>(n));
  });
  for (const std::uint64_t count : rays) result.rays += count;
  return result;
}

}  // namespace radiosity
