#pragma once

#include "experiments/device/device_costs.hpp"
#include "experiments/device/device_results.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace radiosity {

/// What the columns of graphics processors in document 004's Tables 1 to 5 and document 000's Figures 11 and
/// 12 need.
struct DeviceBenchmarkOptions {
  std::vector<LowRankSize> sizes;        ///< Tables 1 to 4, each k = 216 also as 224, a multiple of 32
  std::vector<LowRankSize> large_sizes;  ///< Table 5: sparse V only
  double largest_timed = 1.2e7;          ///< n k above which a size is left out
  std::string scene = "cornell-box-closed";
  std::vector<Index> patches = {400, 800};
  long bounces = 3;  ///< of times over patches
  Index patches_over_bounces = 400;
  std::vector<long> bounce_counts = {1, 2, 3, 5, 10};
  ProductCostOptions costs;
  double seconds = 0.05;  ///< for each time
  bool full = false;      ///< said in the results
  std::uint64_t seed = 1;

  /// The document's sizes; quick, or with everything.
  DeviceBenchmarkOptions();
  static DeviceBenchmarkOptions full_sizes();
};

/// Throws Error where something does not fit into the device or into free memory.
DeviceResults benchmark_device(const std::shared_ptr<GlDevice>& device, const DeviceBenchmarkOptions& options,
                               const OperatorRegistry& cpu, Monitor& monitor);

/// Who measured, and what to think of it.
ReportText device_text(const DeviceResults& results);
/// Frames a second with and without transfers, k = 216 beside 224, and shared with the CPU.
ReportTable device_frames_table(const DeviceResults& results, const std::string& command);
/// Times of document 000's methods; `rounds` are over_patches or over_bounces.
ReportTable device_bounces_table(const DeviceResults& results, const std::vector<DeviceSpeedRound>& rounds,
                                 const std::string& caption, const std::string& command);
/// Processor seconds against those of the CPU's kernels.
ReportTable device_costs_table(const DeviceResults& results, const std::string& command);

/// All of them.
ReportSection device_section(const DeviceResults& results, const std::string& command);

}  // namespace radiosity
