#pragma once

#include "experiments/device/device_results.hpp"
#include "gpu/gl_device.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiosity {

/// Times frames of one n x k on a device, with one column and with three: Y random, V sparse, and full where
/// `with_full`. `seconds` for each of the times. Throws Error where it does not fit into the device.
std::vector<DeviceFrames> time_device_frames(const std::shared_ptr<GlDevice>& device, const LowRankSize& size,
                                             bool with_full, double seconds, std::uint64_t seed);

}  // namespace radiosity
