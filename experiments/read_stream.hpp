#pragma once

#include "kernels/aligned_memory.hpp"

#include <cstddef>
#include <vector>

namespace radiosity {

/// Reads a large buffer at the speed of memory, a quarter at a time: about as long as an operator takes, so
/// that the best of many readings is as likely to be undisturbed.
class ReadStream {
 public:
  static constexpr int quarters = 4;

  /// A buffer of about `bytes`: more than the last cache holds, or the caches' speed is measured.
  explicit ReadStream(std::size_t bytes);

  std::size_t quarter_bytes() const { return chunks / quarters * chunk_words_ * sizeof(double); }
  /// Sums the next quarter with the threads in force, in one round of quarters asking for what comes next, in
  /// the other leaving that to the processor: which is faster depends on the machine, and its bandwidth is
  /// the better of both. Throws Error where the memory is broken.
  void read_quarter();

 private:
  static constexpr std::size_t chunks = 256;
  static constexpr std::size_t lanes = 32;

  double* begin(std::size_t chunk) const { return words_.data() + chunk * chunk_words_; }
  template <bool fetch_ahead>
  double sum(const double* words) const;

  std::size_t chunk_words_;
  AlignedBuffer<double> words_;
  std::vector<double> sums_;
  std::size_t readings_ = 0;
};

}  // namespace radiosity
