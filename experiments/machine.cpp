#include "experiments/machine.hpp"

#include "experiments/read_stream.hpp"
#include "foundation/parallel.hpp"
#include "foundation/stopwatch.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <unistd.h>

namespace radiosity {
namespace {

/// Twice what the last cache holds, within reason: touching fresh memory takes longer than reading it.
std::size_t buffer_bytes() {
  constexpr std::size_t least = std::size_t{1} << 28;
  constexpr std::size_t most = std::size_t{1} << 29;
  const long cache = sysconf(_SC_LEVEL3_CACHE_SIZE);
  return std::clamp(2 * static_cast<std::size_t>(std::max(cache, 0L)), least, most);
}

}  // namespace

double measure_read_bandwidth(double seconds) {
  ReadStream stream(buffer_bytes());
  double best = 0;
  const Stopwatch total;
  do {
    const Stopwatch quarter;
    stream.read_quarter();
    best = std::max(best, 1e-9 * static_cast<double>(stream.quarter_bytes()) / quarter.seconds());
  } while (total.seconds() < seconds);
  return best;
}

double load_average() {
  double average = 0;
  return getloadavg(&average, 1) == 1 ? average : 0;
}

std::string processor_name() {
  std::ifstream information("/proc/cpuinfo");
  for (std::string line; std::getline(information, line);) {
    const auto colon = line.find(':');
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos && colon + 2 < line.size())
      return line.substr(colon + 2);
  }
  return "unknown";
}

Machine measure_machine() {
  return {processor_name(), ThreadLimit::current(), measure_read_bandwidth(), load_average()};
}

}  // namespace radiosity
