#include "experiments/device/device_frames.hpp"

#include "experiments/device/repeated_timing.hpp"
#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/low_rank_radiosity/solved_factors.hpp"
#include "foundation/random.hpp"
#include "foundation/stopwatch.hpp"
#include "gpu/low_rank_frame.hpp"
#include "gpu/low_rank_on_device.hpp"
#include "gpu/sparse_v_on_device.hpp"
#include "kernels/segment_sums.hpp"

#include <functional>
#include <optional>
#include <utility>

namespace radiosity {
namespace {

/// X = V' E on the CPU.
using CpuSums = std::function<void(const Field& E, FieldRef X)>;

/// Frames with one V.
class FrameTimer {
 public:
  FrameTimer(GlDevice& device, const FactorsOnDevice& factors, const TallMatrix<float>& Y, CpuSums cpu_sums,
             const Field& E, double seconds)
      : device_(device),
        Y_(Y),
        cpu_sums_(std::move(cpu_sums)),
        E_(E),
        seconds_(seconds),
        X_(Y.columns(), E.cols()),
        B_(E.rows(), E.cols()),
        frame_(factors, E.cols()) {}

  DeviceFrameTimes on_device() {
    frame_.send(E_);
    DeviceFrameTimes times;
    times.sums = time_on_device(device_, seconds_, [this] { frame_.sum(); });
    times.frame = time_on_device(device_, seconds_, [this] { frame_.compute(); });
    times.with_transfers = time_by_clock(seconds_, [this] {
      frame_.send(E_);
      frame_.compute();
      frame_.receive(B_);
    });
    return times;
  }

  Timing on_cpu() {
    return time_by_clock(seconds_, [this] {
      cpu_sums_(E_, X_);
      subtract_product(Y_, X_, E_, B_);
    });
  }

  /// The device has a frame while the CPU computes the X of the next.
  Timing hybrid() {
    start_hybrid_frame();
    const Timing timing = time_by_clock(seconds_, [this] {
      cpu_sums_(E_, X_);
      frame_.receive(B_);
      frame_.send(E_);
      frame_.compute_with(X_);
      device_.flush();
    });
    frame_.receive(B_);
    return timing;
  }

 private:
  void start_hybrid_frame() {
    cpu_sums_(E_, X_);
    frame_.send(E_);
    frame_.compute_with(X_);
  }

  GlDevice& device_;
  const TallMatrix<float>& Y_;
  CpuSums cpu_sums_;
  const Field& E_;
  double seconds_;
  Field X_;
  Field B_;
  LowRankFrame frame_;
};

Field random_light(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random(seed, 0);
  return Field::NullaryExpr(rows, columns, [&] { return random.uniform(); });
}

}  // namespace

std::vector<DeviceFrames> time_device_frames(const std::shared_ptr<GlDevice>& device, const LowRankSize& size,
                                             bool with_full, double seconds, std::uint64_t seed) {
  const CurrentContext current(*device->context());
  const SolvedFactors factors = random_factors(size, seed);
  std::vector<DeviceFrames> results;
  for (const Index columns : {1, 3}) results.push_back({.size = size, .columns = columns});
  {
    const Stopwatch upload;
    const SparseVOnDevice sparse(device, factors.Y, factors.V, device->preferred_strategy());
    const double upload_seconds = upload.seconds();
    for (DeviceFrames& result : results) {
      const Field E = random_light(size.rows, result.columns, seed);
      FrameTimer timer(
          *device, sparse, factors.Y,
          [&](const Field& field, FieldRef X) { segment_sums(factors.V, field, X, RowOrder::sorted); }, E,
          seconds);
      result.upload_seconds = upload_seconds;
      result.sparse = timer.on_device();
      result.cpu_sparse = timer.on_cpu();
      result.hybrid_sparse = timer.hybrid();
    }
  }
  if (!with_full) return results;
  const TallMatrix<float> V = full_matrix(factors.V);
  const LowRankOnDevice full(device, factors.Y, V, device->preferred_strategy());
  for (DeviceFrames& result : results) {
    const Field E = random_light(size.rows, result.columns, seed);
    FrameTimer timer(
        *device, full, factors.Y, [&](const Field& field, FieldRef X) { multiply_transposed(V, field, X); },
        E, seconds);
    result.full = timer.on_device();
    result.cpu_full = timer.on_cpu();
    result.hybrid_full = timer.hybrid();
  }
  return results;
}

}  // namespace radiosity
