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
  const bool fetch_ahead = readings_ / quarters % 2 == 1;
  const std::size_t first = readings_ % quarters * (chunks / quarters);
  ++readings_;
  parallel_for(chunks / quarters, [&](std::size_t k) {
    const double* words = begin(first + k);
    sums_[first + k] = fetch_ahead ? sum<true>(words) : sum<false>(words);
  });
  if (sums_[first] != static_cast<double>(chunk_words_))
    fail("the memory does not hold what was written to it");
}

template <bool fetch_ahead>
double ReadStream::sum(const double* words) const {
  // 32 sums side by side, so that the loop waits for memory and not for its own additions. Processors fetch
  // ahead by themselves, but not beyond the page (512 numbers) that they read: some read a quarter faster
  // when they are asked to, others slower.
  constexpr std::size_t fetched_ahead = 1024;
  constexpr std::size_t line = 8;
  double sums[lanes] = {};
  for (std::size_t i = 0; i < chunk_words_; i += lanes) {
    if constexpr (fetch_ahead)
      for (std::size_t k = 0; k < lanes; k += line) __builtin_prefetch(words + i + k + fetched_ahead);
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += words[i + k];
  }
  double total = 0;
  for (const double part : sums) total += part;
  return total;
}

}  // namespace radiosity
