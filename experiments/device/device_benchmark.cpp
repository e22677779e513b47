#include "experiments/device/device_benchmark.hpp"

#include "experiments/device/device_bounces.hpp"
#include "experiments/device/device_frames.hpp"
#include "experiments/dxt_radiosity/light_answers.hpp"
#include "experiments/low_rank_radiosity/published_tables.hpp"
#include "experiments/machine.hpp"
#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "foundation/parallel.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace radiosity {
namespace {

/// The document blames 216 for not being a multiple of 32.
constexpr Index blamed_rank = 216;
constexpr Index rounded_rank = 224;

void require_room(const LowRankSize& size, bool with_full) {
  const double entries = static_cast<double>(size.rows) * static_cast<double>(size.rank);
  const double copies = with_full ? 4 : 2;  // here and, on a software renderer, there
  require_available_memory(fmt::format("a frame of {} x {}", size.rows, size.rank),
                           entries * sizeof(float) * copies, "leave --full away");
}

void add_frames(const std::shared_ptr<GlDevice>& device, const DeviceBenchmarkOptions& options,
                const std::vector<LowRankSize>& sizes, bool with_full, DeviceResults& results,
                Monitor& monitor) {
  for (const LowRankSize& size : sizes) {
    if (static_cast<double>(size.rows) * static_cast<double>(size.rank) > options.largest_timed) continue;
    monitor.checkpoint(fmt::format("frames of {} x {}", size.rows, size.rank), 0);
    require_room(size, with_full);
    for (DeviceFrames& frames : time_device_frames(device, size, with_full, options.seconds, options.seed))
      results.frames.push_back(frames);
  }
}

DeviceSpeedRound time_bounces(const std::shared_ptr<GlDevice>& device, const DeviceBenchmarkOptions& options,
                              const FormFactors& form_factors, long bounces, const OperatorRegistry& cpu,
                              Monitor& monitor) {
  monitor.checkpoint(fmt::format("{} bounces of {} patches", bounces, form_factors.patch_count()), 0);
  return time_device_bounces(device, form_factors, form_factors.mesh->emission, bounces, options.seconds,
                             cpu);
}

FormFactors factors_of(const DeviceBenchmarkOptions& options, Index patches, Monitor& monitor) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(options.scene), {.patches = patches}));
  return compute_form_factors(mesh, {.seed = options.seed}, monitor);
}

}  // namespace

DeviceBenchmarkOptions::DeviceBenchmarkOptions() {
  for (const PublishedSpeeds& row : published_table_3()) {
    sizes.push_back(row.size);
    if (row.size.rank == blamed_rank) sizes.push_back({row.size.rows, rounded_rank});
  }
  for (const PublishedSecondMachine& row : published_table_5()) large_sizes.push_back(row.size);
}

DeviceBenchmarkOptions DeviceBenchmarkOptions::full_sizes() {
  DeviceBenchmarkOptions options;
  options.largest_timed = 1e9;
  options.patches = {400, 800, 1600, 3300};
  options.patches_over_bounces = 3300;
  options.bounce_counts = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  options.costs.patches = 8192;
  options.seconds = options.costs.seconds = 0.5;
  options.full = true;
  return options;
}

DeviceResults benchmark_device(const std::shared_ptr<GlDevice>& device, const DeviceBenchmarkOptions& options,
                               const OperatorRegistry& cpu, Monitor& monitor) {
  const GlContext& context = *device->context();
  DeviceResults results;
  results.renderer = context.renderer();
  results.vendor = context.vendor();
  results.version = context.version();
  results.software = context.software();
  results.cpu = processor_name();
  results.threads = ThreadLimit::current();
  results.full = options.full;
  monitor.checkpoint("costs of products", 0);
  results.costs =
      measure_product_costs(device, factors_of(options, options.costs.patches, monitor), options.costs, cpu);
  add_frames(device, options, options.sizes, true, results, monitor);
  add_frames(device, options, options.large_sizes, false, results, monitor);
  for (const Index patches : options.patches)
    results.over_patches.push_back(
        time_bounces(device, options, factors_of(options, patches, monitor), options.bounces, cpu, monitor));
  if (options.bounce_counts.empty()) return results;
  const FormFactors form_factors = factors_of(options, options.patches_over_bounces, monitor);
  for (const long bounces : options.bounce_counts)
    results.over_bounces.push_back(time_bounces(device, options, form_factors, bounces, cpu, monitor));
  return results;
}

}  // namespace radiosity
