#pragma once

#include "experiments/comparison.hpp"
#include "experiments/json_objects.hpp"
#include "experiments/low_rank_benchmark.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Pieces of a frame of document 004's Algorithm 2 on a device.
struct DeviceFrameTimes {
  Timing sums = {};            ///< X = V' E, E and X on the device
  Timing frame = {};           ///< B = E - Y X with X, E and B on the device
  Timing with_transfers = {};  ///< the same from an E in the CPU's memory to a B there
};

/// One n x k, c columns at once.
struct DeviceFrames {
  LowRankSize size = {};
  Index columns = 1;
  double upload_seconds = 0;  ///< of Y and sparse V, once
  DeviceFrameTimes sparse = {};
  std::optional<DeviceFrameTimes> full = {};
  /// Frames with transfers, one after the other, whose X the CPU computes while the device has the frame
  /// before; seconds a frame.
  Timing hybrid_sparse = {};
  std::optional<Timing> hybrid_full = {};
  Timing cpu_sparse = {};  ///< the whole frame on the CPU, all threads
  std::optional<Timing> cpu_full = {};
};

/// A way from E to B of document 000, all channels of one light.
struct DeviceMethodSpeed {
  std::string name;  ///< as in DxtSpeeds
  std::size_t bytes = 0;
  Timing on_device = {};
  Timing with_transfers = {};
  double difference = 0;  ///< in B, from the same on the CPU: relative, in the area norm
};

struct DeviceSpeedRound {
  Index patches = 0;
  Index channels = 0;
  long bounces = 0;
  std::vector<DeviceMethodSpeed> methods = {};

  /// Null where it was not measured.
  const DeviceMethodSpeed* find(const std::string& name) const;
};

/// What the whole process spends on a product: on a software renderer, a measure of the shaders.
struct ProductCost {
  std::string product;  ///< "dense:f32"
  Index columns = 1;
  double cpu_seconds = 0;         ///< of all threads, by the kernels of the CPU
  double device_cpu_seconds = 0;  ///< by the device's driver, transfers of fields included
  double limit = 0;               ///< of the ratio, on a software renderer

  double ratio() const { return device_cpu_seconds / cpu_seconds; }
};

/// All that `radiosity bench --device gl` measures.
struct DeviceResults {
  std::string renderer;
  std::string vendor;
  std::string version;
  bool software = false;  ///< the renderer computes on the CPU
  std::string cpu;
  int threads = 0;
  bool full = false;  ///< the full sizes
  std::vector<DeviceFrames> frames;
  std::vector<DeviceSpeedRound> over_patches;
  std::vector<DeviceSpeedRound> over_bounces;
  std::vector<ProductCost> costs;

  /// Null where it was not measured.
  const DeviceFrames* find(const LowRankSize& size, Index columns) const;
};

/// The same as JSON, with "kind" before all.
Json device_results_json(const DeviceResults& results);

/// Writes JSON that appears whole or not at all.
void write_device_results(const std::filesystem::path& file, const DeviceResults& results);

/// What write_device_results() has written, by this or another machine. Throws Error in a sentence for files
/// that cannot be read or are something else.
DeviceResults read_device_results(const std::filesystem::path& file);

}  // namespace radiosity
