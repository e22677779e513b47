#pragma once

#include "scene/spectrum.hpp"

namespace radiosity {

/// Reflectances that Cornell measured in the real box (rho, 0 <= rho <= 1) and the relative emission of its
/// light.
const MeasuredSpectrum& cornell_white();
const MeasuredSpectrum& cornell_green();
const MeasuredSpectrum& cornell_red();
MeasuredSpectrum cornell_light();

}  // namespace radiosity
