#pragma once

#include "experiments/device/device_results.hpp"
#include "form_factors/form_factors.hpp"
#include "gpu/gl_device.hpp"
#include "operators/operator_registry.hpp"

#include <memory>

namespace radiosity {

/// Times document 000's k bounces on a device: the naive solver, the same with all channels packed, and sums
/// of bounces in float32 and compressed, by the operators of `cpu` copied there. `emission`: n x channels.
/// `seconds` for each of the times.
DeviceSpeedRound time_device_bounces(const std::shared_ptr<GlDevice>& device, const FormFactors& form_factors,
                                     const Field& emission, long bounces, double seconds,
                                     const OperatorRegistry& cpu);

}  // namespace radiosity
