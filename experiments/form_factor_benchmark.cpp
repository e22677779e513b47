#include "experiments/form_factor_benchmark.hpp"

#include "form_factors/pair_exchange.hpp"
#include "foundation/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <stdlib.h>
#include <vector>

namespace radiosity {
namespace {

// The packets of some patches, spread over the scene, with every cluster: a few million rays.
std::vector<RayPacket> sample_packets(const PairExchange& exchange, Index patches) {
  constexpr std::uint64_t wanted_rays = std::uint64_t{1} << 22U;
  const auto& clusters = exchange.geometry().clusters();
  constexpr Index sampled_patches = 48;
  const auto stride = static_cast<std::size_t>(std::max<Index>(1, patches / sampled_patches));
  std::vector<RayPacket> packets;
  ExchangeWorkspace workspace = exchange.make_workspace();
  workspace.record = &packets;
  ClusterExchange result;
  std::size_t patch = 0;
  for (const PatchCluster& own : clusters) {
    for (int i = own.begin; i < own.end; ++i) {
      if (patch++ % stride != 0) continue;
      for (const PatchCluster& other : clusters) {
        const auto pair = exchange.relate(own, other);
        if (!pair.nothing) exchange.evaluate(i, pair, 0, workspace, result);
        if (packets.size() * RayPacket::size > wanted_rays) return packets;
      }
    }
  }
  return packets;
}

// CPU seconds of the ray tracer alone on the same packets, as many threads at work as in the assembly.
double replay_seconds(const Occluders& occluders, std::span<const RayPacket> packets) {
  constexpr std::size_t piece = 4096;
  std::vector<double> seconds((packets.size() + piece - 1) / piece);
  parallel_for(seconds.size(), [&](std::size_t k) {
    const auto part = packets.subspan(k * piece, std::min(piece, packets.size() - k * piece));
    seconds[k] = occluders.tracing_seconds(part);
  });
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

}  // namespace

FormFactorBenchmark benchmark_form_factors(std::shared_ptr<const PatchMesh> mesh,
                                           const FormFactorOptions& options, Monitor& monitor) {
  FormFactorOptions raw = options;
  raw.closure = Closure::none;
  FormFactorBenchmark result;
  result.scene = mesh->scene->name;
  result.patches = mesh->patch_count();

  const PairExchange exchange(*mesh, options.tolerance, options.seed);
  const std::vector<RayPacket> packets = sample_packets(exchange, mesh->patch_count());
  // Half of the replays before the assembly, half after it: the machine's speed changes with its load.
  constexpr int replays = 5;
  std::vector<double> seconds;
  const auto replay = [&] {
    for (int k = 0; k < replays; ++k) seconds.push_back(replay_seconds(exchange.occluders(), packets));
  };
  replay();
  result.quality = compute_form_factors(mesh, raw, monitor).quality;
  replay();

  const double n = static_cast<double>(result.patches);
  result.microseconds_per_factor = n > 0 ? 1e6 * result.quality.cpu_seconds / (n * n) : 0;
  result.assembly_rate = static_cast<double>(result.quality.rays) / result.quality.cpu_seconds;
  std::sort(seconds.begin(), seconds.end());
  const auto rays = static_cast<double>(packets.size() * RayPacket::size);
  if (rays > 0) {
    result.tracer_rate = rays / seconds[replays];
    result.fastest_tracer_rate = rays / seconds[0];
  }
  if (getloadavg(&result.load, 1) != 1) result.load = 0;
  return result;
}

std::string form_factor_benchmark_text(const FormFactorBenchmark& b) {
  std::string text = fmt::format(
      "{}: n = {}, {} form factors\n"
      "  assembly      {:8.2f} s wall, {:8.2f} s CPU, {:.3f} us of CPU a directed form factor\n"
      "  rays          {:8.1f} million, {:.1f} million a CPU second of the whole assembly\n",
      b.scene, b.patches, b.quality.method, b.quality.seconds, b.quality.cpu_seconds,
      b.microseconds_per_factor, 1e-6 * static_cast<double>(b.quality.rays), 1e-6 * b.assembly_rate);
  if (b.tracer_rate > 0)
    text += fmt::format(
        "  rtcOccluded16 {:8.1f} million a CPU second (median; fastest {:.1f}) on the same rays: ratio "
        "{:.2f}\n",
        1e-6 * b.tracer_rate, 1e-6 * b.fastest_tracer_rate, b.assembly_rate / b.tracer_rate);
  text += fmt::format("  row sums      {:.9f} to {:.9f}, rms deviation {:.2e}; machine load {:.2f}\n",
                      b.quality.row_sum_min, b.quality.row_sum_max, b.quality.row_sum_rms, b.load);
  return text;
}

}  // namespace radiosity
