#pragma once

#include "experiments/comparison.hpp"
#include "gpu/gl_device.hpp"

#include <functional>

namespace radiosity {

/// Repeats `work`, which says how many seconds it took, until `seconds` are over, at least three times after
/// a first one that is not counted.
Timing time_repeatedly(double seconds, const std::function<double()>& work);

/// The same with the time by the clock.
Timing time_by_clock(double seconds, const std::function<void()>& work);

/// The same with the time of the device in what `work` asks of it. The context is current.
Timing time_on_device(GlDevice& device, double seconds, const std::function<void()>& work);

}  // namespace radiosity
