#pragma once

#include <cstdint>

namespace radiosity {

/// Mixes a 64-bit word (the finalizer of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t mix_bits(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9ULL;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebULL;
  return word ^ (word >> 31);
}

/// A small generator that any (seed, stream) pair can start: work item i draws from stream i, so that random
/// numbers depend neither on the number of threads nor on the order of the work. Meets
/// UniformRandomBitGenerator.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mix_bits(seed + 0x9e3779b97f4a7c15ULL) ^ mix_bits(stream * 0xd1342543de82ef95ULL + 1)) {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }

  result_type operator()() { return mix_bits(state_ += 0x9e3779b97f4a7c15ULL); }

  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform in 0 ... count - 1; 0 < count < 2^50.
  std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
  }

 private:
  std::uint64_t state_;
};

}  // namespace radiosity
