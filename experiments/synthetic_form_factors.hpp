#pragma once

#include "form_factors/form_factors.hpp"

namespace radiosity {

/// A kernel of n patches of area 1 in which every entry is positive and rows sum to less than 1, for timing
/// products; reflectance 0.5.
FormFactors synthetic_form_factors(Index n, Index channels = 1);

}  // namespace radiosity
