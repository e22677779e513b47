#include "experiments/device/repeated_timing.hpp"

#include "foundation/stopwatch.hpp"

#include <utility>
#include <vector>

namespace radiosity {

Timing time_repeatedly(double seconds, const std::function<double()>& work) {
  constexpr std::size_t least = 3;
  work();  // compiles shaders and touches memory that later ones find in place
  std::vector<double> samples;
  const Stopwatch all;
  while (samples.size() < least || all.seconds() < seconds) samples.push_back(work());
  return Timing::of(std::move(samples));
}

Timing time_by_clock(double seconds, const std::function<void()>& work) {
  return time_repeatedly(seconds, [&] {
    const Stopwatch watch;
    work();
    return watch.seconds();
  });
}

Timing time_on_device(GlDevice& device, double seconds, const std::function<void()>& work) {
  return time_repeatedly(seconds, [&] {
    {
      const GlTimer::Measurement measurement(device.timer());
      work();
    }
    return device.timer().seconds();
  });
}

}  // namespace radiosity
