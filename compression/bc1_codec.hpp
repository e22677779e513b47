#pragma once

#include "compression/level_fit.hpp"
#include "kernels/block_formats.hpp"

#include <array>

namespace radiosity {

/// What a BC1 block is to hold: codes in [0, 255] of three channels, and how much each texel's squared error
/// counts, >= 0 and finite. A texel of weight 0 is free: its value does not matter. One channel alone belongs
/// into green, which has 6 bits; the others stay 0 and cost nothing.
struct Bc1Texels {
  std::array<Texels, 3> code = {Texels::Zero(), Texels::Zero(), Texels::Zero()};  ///< red, green, blue
  Texels weight = Texels::Ones();
};

enum class Bc1Fit {
  range,   ///< ends at the texels that lie outermost along the principal axis, as most encoders have it
  cluster  ///< least-squares ends and nearest levels in turn, from several starts; never worse than range
};

/// A block of small squared error. It always has four colours: first > second, or first == second and all
/// indices are 0. Texels that are 0, but for free ones, become exactly 0; so do all of a block whose texels
/// are all free. Constants are met within half a step of every channel, 255/62 or 255/126. Throws UsageError
/// for codes that are not in [0, 255] and weights that are negative or NaN.
Bc1Block encode_bc1(const Bc1Texels& texels, Bc1Fit fit);

/// The sum over texels and channels of weight (code - palette)^2, which encode_bc1 makes small.
double squared_error(const Bc1Texels& texels, const Bc1Block& block);

}  // namespace radiosity
