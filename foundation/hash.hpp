#pragma once

#include "foundation/random.hpp"

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace radiosity {

/// A 64-bit fingerprint of values fed in order; not cryptographic. Says whether a stored kernel fits a scene.
class Fingerprint {
 public:
  void add(std::uint64_t word) { state_ = mix_bits(state_ ^ (word + 0x9e3779b97f4a7c15ULL + (state_ << 6))); }

  void add(double value) {
    std::uint64_t bits;
    if (value == 0) value = 0;  // -0 and 0 are one value
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }

  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }

  void add(std::span<const double> values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const double value : values) add(value);
  }

  std::uint64_t value() const { return mix_bits(state_); }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3ULL;
};

}  // namespace radiosity
