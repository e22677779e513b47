#pragma once

#include <cstdint>

namespace radiosity {

/// IEEE 754 binary16 as it is stored; arithmetic happens in float32.
struct Half {
  std::uint16_t bits = 0;
};

/// Round to nearest even, in one step; overflow gives infinity, NaN stays NaN.
Half to_half(float value);
Half to_half(double value);

/// Exact.
float to_float(Half value);

}  // namespace radiosity
