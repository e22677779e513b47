#include "kernels/half.hpp"

#include <bit>
#include <cmath>

namespace radiosity {

Half to_half(double value) {
  const auto sign = static_cast<std::uint16_t>(std::signbit(value) ? 0x8000 : 0);
  const double magnitude = std::fabs(value);
  std::uint16_t bits;
  if (std::isnan(value)) {
    bits = 0x7e00;
  } else if (magnitude >= 65520.0) {  // half way from the largest number, 65504, to the next power of two
    bits = 0x7c00;
  } else if (magnitude < 0x1p-14) {
    // Subnormal numbers are multiples of 2^-24. Adding 2^28 rounds to that grid in the processor, ties to
    // even.
    const double grid = magnitude + 0x1p28;
    bits = static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(grid) & 0x7ff);
  } else {
    // Keep 10 of the 52 fraction bits; a carry moves on to the exponent as it should.
    std::uint64_t word = std::bit_cast<std::uint64_t>(magnitude);
    word += (std::uint64_t{1} << 41) - 1 + ((word >> 42) & 1);
    const std::uint64_t exponent_offset = std::uint64_t{1023 - 15} << 10;
    bits = static_cast<std::uint16_t>((word >> 42) - exponent_offset);
  }
  return {static_cast<std::uint16_t>(bits | sign)};
}

Half to_half(float value) {
  return to_half(static_cast<double>(value));
}

float to_float(Half value) {
  const std::uint32_t sign = static_cast<std::uint32_t>(value.bits & 0x8000) << 16;
  const std::uint32_t magnitude = static_cast<std::uint32_t>(value.bits & 0x7fff) << 13;
  if (magnitude >= 0x0f800000) return std::bit_cast<float>(sign | magnitude | 0x7f800000);  // infinity, NaN
  const float scaled =
      std::bit_cast<float>(magnitude) * 0x1p112f;  // moves the exponent's bias; subnormals too
  return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(scaled));
}

}  // namespace radiosity
