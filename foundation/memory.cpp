#include "foundation/memory.hpp"

#include "foundation/error.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace radiosity {

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double available_memory() {
  std::ifstream information("/proc/meminfo");
  std::string key;
  double kilobytes = 0;
  for (std::string unit; information >> key >> kilobytes; std::getline(information, unit))
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return machine_memory();
}

void require_available_memory(const std::string& subject, double bytes, const std::string& advice) {
  if (const double available = available_memory(); bytes > available)
    fail("{} takes about {} of memory, and {} are free: {}", subject, byte_text(bytes), byte_text(available),
         advice);
}

std::string byte_text(double bytes) {
  constexpr std::array units = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

void release_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace radiosity
