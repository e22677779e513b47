#pragma once

#include "scene/scene.hpp"

#include <array>

namespace radiosity {

/// Values at 400, 404, ..., 700 nm.
using MeasuredSpectrum = std::array<double, 76>;

/// Linear sRGB of a spectrum, such that a flat spectrum of value v gives (v, v, v).
///
/// The rule: integrate spectrum x CIE 1931 colour matching functions under the equal-energy illuminant E
/// (trapezoidal rule over 400 ... 700 nm; the functions as the multi-lobe fit of Wyman, Sloan, Shirley 2013,
/// JCGT 2(2), listing 1), divide each of X, Y, Z by that of a flat spectrum of value 1, scale to the white
/// point D65 (von Kries in XYZ), and multiply by the matrix of IEC 61966-2-1. Nothing is clamped: saturated
/// spectra may leave [0, 1].
Color linear_srgb(const MeasuredSpectrum& spectrum);

/// Weight of each linear sRGB channel in the luminance Y.
Color luminance_weights();

}  // namespace radiosity
