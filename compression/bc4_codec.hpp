#pragma once

#include "compression/level_fit.hpp"
#include "kernels/block_formats.hpp"

namespace radiosity {

/// What a BC4 block is to hold: codes in [0, 255], and how much each texel's squared error counts, >= 0 and
/// finite. A texel of weight 0 is free: its value does not matter.
struct Bc4Texels {
  Texels code = Texels::Zero();
  Texels weight = Texels::Ones();
};

/// The better of a block of eight levels between two ends and one of six levels beside 0 and 255, which suits
/// zeros among other codes: ends by least squares and nearest levels in turn, from a few starts. Texels that
/// are 0, but for free ones, become exactly 0; so do all of a block whose texels are all free. Constants are
/// met within half a code. Throws UsageError for codes that are not in [0, 255] and weights that are negative
/// or NaN.
Bc4Block encode_bc4(const Bc4Texels& texels);

/// The sum over texels of weight (code - palette)^2, which encode_bc4 makes small.
double squared_error(const Bc4Texels& texels, const Bc4Block& block);

}  // namespace radiosity
