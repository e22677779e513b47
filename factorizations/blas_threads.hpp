#pragma once

namespace radiosity {

/// Sets OpenBLAS's number of threads, which holds for the whole process, and gives it back at the end.
class BlasThreads {
 public:
  explicit BlasThreads(int count);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

  static int current();

 private:
  int before_;
};

}  // namespace radiosity
