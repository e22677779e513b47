#pragma once

#include "kernels/half.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace radiosity {

/// The three storage types of a matrix, seen as numbers.
inline double to_double(double value) {
  return value;
}
inline double to_double(float value) {
  return value;
}
inline double to_double(Half value) {
  return to_float(value);
}

/// Rounds once, to nearest.
template <typename Scalar>
Scalar round_to(double value) {
  if constexpr (std::is_same_v<Scalar, Half>)
    return to_half(value);
  else
    return static_cast<Scalar>(value);
}

/// u, the largest relative error of rounding a number in the type's normal range.
template <typename Scalar>
constexpr double unit_roundoff() {
  if constexpr (std::is_same_v<Scalar, double>) return 0x1p-53;
  if constexpr (std::is_same_v<Scalar, float>) return 0x1p-24;
  return 0x1p-11;
}

/// The largest absolute error of rounding a number below the normal range.
template <typename Scalar>
constexpr double underflow_error() {
  if constexpr (std::is_same_v<Scalar, double>) return 0x1p-1074;
  if constexpr (std::is_same_v<Scalar, float>) return 0x1p-150;
  return 0x1p-25;
}

/// The power of two s for which `largest` / s sits high in the type's range with room left for sums (float),
/// or right at its top (Half); 1 for double and for largest = 0. `largest` is finite and >= 0.
template <typename Scalar>
double storage_scale(double largest) {
  if (std::is_same_v<Scalar, double> || largest == 0) return 1;
  const int top = std::is_same_v<Scalar, Half> ? 15 : 0;  // largest / s lies in [2^(top - 1), 2^top)
  // Below 2^-1000 the inverse of the scale would overflow.
  return std::ldexp(1.0, std::max(std::ilogb(largest) + 1 - top, -1000));
}

}  // namespace radiosity
