#pragma once

#include <chrono>
#include <ctime>

namespace radiosity {

/// Wall time, CPU time of the whole process (all threads) and of the calling thread since construction, in
/// seconds.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double cpu_seconds() const { return clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_start_; }
  double thread_cpu_seconds() const { return clock_seconds(CLOCK_THREAD_CPUTIME_ID) - thread_start_; }

 private:
  using Clock = std::chrono::steady_clock;

  static double clock_seconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  Clock::time_point start_ = Clock::now();
  double cpu_start_ = clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
  double thread_start_ = clock_seconds(CLOCK_THREAD_CPUTIME_ID);
};

}  // namespace radiosity
