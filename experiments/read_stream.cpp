#include "experiments/read_stream.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>

namespace radiosity {

ReadStream::ReadStream(std::size_t bytes)
    : chunk_words_(std::max<std::size_t>(bytes / sizeof(double) / chunks / lanes, 1) * lanes),
      words_(chunks * chunk_words_),
      sums_(chunks) {
  parallel_for(chunks, [&](std::size_t chunk) { std::fill_n(begin(chunk), chunk_words_, 1.0); });
}

void ReadStream::read_quarter() {
  next_ = (next_ + 1) % quarters;
  const std::size_t first = next_ * (chunks / quarters);
  parallel_for(chunks / quarters, [&](std::size_t k) { sums_[first + k] = sum(begin(first + k)); });
  if (sums_[first] != static_cast<double>(chunk_words_))
    fail("the memory does not hold what was written to it");
}

double ReadStream::sum(const double* words) const {
  // 32 sums side by side, so that the loop waits for memory and not for its own additions. Processors fetch
  // ahead by themselves, but not beyond the page (512 numbers) that they read: asked to, they read a quarter
  // faster.
  constexpr std::size_t fetched_ahead = 1024;
  constexpr std::size_t line = 8;
  double sums[lanes] = {};
  for (std::size_t i = 0; i < chunk_words_; i += lanes) {
    for (std::size_t k = 0; k < lanes; k += line) __builtin_prefetch(words + i + k + fetched_ahead);
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += words[i + k];
  }
  double total = 0;
  for (const double part : sums) total += part;
  return total;
}

}  // namespace radiosity
