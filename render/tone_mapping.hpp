#pragma once

#include "render/picture.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

/// From radiance to a screen, in three steps that are all there is to it:
/// 1. exposure: linear RGB times a constant, chosen such that the 95th percentile of luminance (Rec. 709
/// weights) maps to 0.7;
/// 2. clamping to [0, 1];
/// 3. the sRGB transfer function (IEC 61966-2-1), 8 bits, rounded.
/// Percentiles are weighted: every pixel that is not black counts alike in a picture, every patch by its area
/// in a mesh.

constexpr double exposure_percentile = 0.95;
constexpr double exposure_target = 0.7;

/// The constant of step 1 for a picture; 1 for a black one.
double exposure_of(const Picture& picture);

/// The same for the radiance B / pi of patches; B is n x 1 or n x 3, W/m^2.
double exposure_of(const Eigen::MatrixXd& B, const Eigen::VectorXd& area);

/// Step 3 without the rounding: linear [0, 1] to sRGB [0, 1].
double srgb_from_linear(double linear);

/// Steps 2 and 3 of one value that is already exposed.
std::uint8_t srgb_byte(double exposed);

/// All three steps: 3 x width x height bytes.
std::vector<std::uint8_t> tone_mapped(const Picture& picture, double exposure);

}  // namespace radiosity
