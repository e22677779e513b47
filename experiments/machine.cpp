#include "experiments/machine.hpp"

#include "foundation/parallel.hpp"
#include "foundation/stopwatch.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <unistd.h>
#include <vector>

namespace radiosity {

namespace {

std::string cpu_model() {
  std::ifstream information("/proc/cpuinfo");
  for (std::string line; std::getline(information, line);) {
    const auto colon = line.find(':');
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos && colon + 2 < line.size())
      return line.substr(colon + 2);
  }
  return "unknown";
}

/// Eight independent sums, so that the loop waits for memory and not for its own additions.
std::uint64_t sum_words(const std::uint64_t* words, std::size_t count) {
  std::uint64_t sums[8] = {};
  for (std::size_t i = 0; i + 8 <= count; i += 8)
    for (std::size_t k = 0; k < 8; ++k) sums[k] += words[i + k];
  std::uint64_t total = 0;
  for (const std::uint64_t sum : sums) total += sum;
  return total;
}

/// Twice what the last cache holds, within reason: touching fresh memory takes longer than reading it.
std::size_t buffer_bytes() {
  constexpr std::size_t least = std::size_t{1} << 28;
  constexpr std::size_t most = std::size_t{1} << 29;
  const long cache = sysconf(_SC_LEVEL3_CACHE_SIZE);
  return std::clamp(2 * static_cast<std::size_t>(std::max(cache, 0L)), least, most);
}

}  // namespace

double measure_read_bandwidth(double seconds) {
  constexpr std::size_t chunk_words = std::size_t{1} << 17;  // 1 MB
  const std::size_t chunks = buffer_bytes() / (chunk_words * sizeof(std::uint64_t));
  const std::unique_ptr<std::uint64_t[]> words(new std::uint64_t[chunks * chunk_words]);
  std::vector<std::uint64_t> sums(chunks);
  parallel_for(chunks, [&](std::size_t c) {  // pages belong to the buffer only once they have been written
    std::fill_n(words.get() + c * chunk_words, chunk_words, c);
  });

  double best = 0;
  const Stopwatch total;
  do {
    const Stopwatch pass;
    parallel_for(chunks,
                 [&](std::size_t c) { sums[c] = sum_words(words.get() + c * chunk_words, chunk_words); });
    const double bytes = static_cast<double>(chunks * chunk_words * sizeof(std::uint64_t));
    best = std::max(best, 1e-9 * bytes / pass.seconds());
    words[0] ^= sums[chunks - 1];  // the next pass depends on this one: nothing to optimise away
  } while (total.seconds() < seconds);
  return best;
}

double load_average() {
  double average = 0;
  return getloadavg(&average, 1) == 1 ? average : 0;
}

double available_memory() {
  std::ifstream information("/proc/meminfo");
  std::string key;
  double kilobytes = 0;
  for (std::string unit; information >> key >> kilobytes; std::getline(information, unit))
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Machine measure_machine() {
  return {cpu_model(), ThreadLimit::current(), measure_read_bandwidth(), load_average()};
}

}  // namespace radiosity
