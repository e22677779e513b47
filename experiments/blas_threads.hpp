#pragma once

#include <cblas.h>

namespace radiosity {

/// Sets OpenBLAS's number of threads, which it keeps for the whole process, and gives it its own back.
class BlasThreads {
 public:
  explicit BlasThreads(int count) : before_(openblas_get_num_threads()) { openblas_set_num_threads(count); }
  ~BlasThreads() { openblas_set_num_threads(before_); }
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int before_;
};

}  // namespace radiosity
