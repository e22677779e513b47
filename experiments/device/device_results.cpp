#include "experiments/device/device_results.hpp"

#include <algorithm>

namespace radiosity {

const DeviceMethodSpeed* DeviceSpeedRound::find(const std::string& name) const {
  const auto own = std::find_if(methods.begin(), methods.end(),
                                [&](const DeviceMethodSpeed& method) { return method.name == name; });
  return own == methods.end() ? nullptr : &*own;
}

const DeviceFrames* DeviceResults::find(const LowRankSize& size, Index columns) const {
  const auto own = std::find_if(frames.begin(), frames.end(), [&](const DeviceFrames& candidate) {
    return candidate.size.rows == size.rows && candidate.size.rank == size.rank &&
           candidate.columns == columns;
  });
  return own == frames.end() ? nullptr : &*own;
}

}  // namespace radiosity
