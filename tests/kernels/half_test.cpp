#include "kernels/half.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace radiosity {
namespace {

Half half_bits(unsigned bits) {
  return {static_cast<std::uint16_t>(bits)};
}

/// The value of a finite code by the definition of binary16.
double defined_value(unsigned bits) {
  const int exponent = static_cast<int>((bits >> 10) & 31);
  const int fraction = static_cast<int>(bits & 1023);
  const double magnitude =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

constexpr unsigned infinity_bits = 0x7c00;

TEST(Half, EveryCodeHasItsDefinedValue) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const float value = to_float(half_bits(bits));
    if ((bits & 0x7fff) > infinity_bits) {
      EXPECT_TRUE(std::isnan(value)) << bits;
    } else if ((bits & 0x7fff) == infinity_bits) {
      EXPECT_EQ(value, (bits & 0x8000) != 0 ? -HUGE_VALF : HUGE_VALF);
    } else {
      EXPECT_EQ(static_cast<double>(value), defined_value(bits)) << bits;
      EXPECT_EQ(std::signbit(value), (bits & 0x8000) != 0) << bits;
    }
  }
}

TEST(Half, EveryCodeSurvivesARoundTrip) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    if ((bits & 0x7fff) > infinity_bits) continue;
    EXPECT_EQ(to_half(to_float(half_bits(bits))).bits, bits);
  }
  EXPECT_TRUE(std::isnan(to_float(to_half(std::numeric_limits<float>::quiet_NaN()))));
}

// Between two neighbours everything is decided by the middle: below it the lower one, above it the upper one,
// at it the even one. Doubles beside the middle also show that a double is rounded once and not by way of
// float.
TEST(Half, RoundsToNearestAndTiesToEven) {
  for (unsigned bits = 0; bits < infinity_bits; ++bits) {
    const double low = defined_value(bits);
    const double high = bits + 1 == infinity_bits ? 65536.0 : defined_value(bits + 1);
    const double middle = (low + high) / 2;
    const unsigned even = bits % 2 == 0 ? bits : bits + 1;
    for (const unsigned sign : {0u, 0x8000u}) {
      const double s = sign == 0 ? 1 : -1;
      EXPECT_EQ(to_half(s * middle).bits, even | sign) << bits;
      EXPECT_EQ(to_half(static_cast<float>(s * middle)).bits, even | sign) << bits;
      EXPECT_EQ(to_half(s * std::nextafter(middle, 0.0)).bits, bits | sign) << bits;
      EXPECT_EQ(to_half(s * std::nextafter(middle, 1e9)).bits, (bits + 1) | sign) << bits;
      EXPECT_EQ(to_half(s * (low + 0.3 * (high - low))).bits, bits | sign) << bits;
    }
  }
}

TEST(Half, LargeNumbersBecomeInfinityAndTinyOnesZero) {
  EXPECT_EQ(to_half(65519.999).bits, 0x7bff);
  EXPECT_EQ(to_half(65520.0).bits, infinity_bits);
  EXPECT_EQ(to_half(1e300).bits, infinity_bits);
  EXPECT_EQ(to_half(-std::numeric_limits<double>::infinity()).bits, infinity_bits | 0x8000);
  EXPECT_EQ(to_half(0x1p-25).bits, 0);  // half way to the smallest number, 2^-24: ties to even
  EXPECT_EQ(to_half(std::nextafter(0x1p-25, 1.0)).bits, 1);
  EXPECT_EQ(to_half(1e-300).bits, 0);
  EXPECT_EQ(to_half(-0.0).bits, 0x8000);
}

}  // namespace
}  // namespace radiosity
