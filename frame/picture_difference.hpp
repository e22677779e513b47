#pragma once

#include "frame/traced_frame.hpp"

#include <array>

namespace radiosity {

/// How a picture differs from a path-traced one, channel by channel (red, green, blue), relative to the mean
/// of that in the channel; 0 in channels that are black in both.
struct PictureDifference {
  std::array<double, 3> mean{};      ///< of picture - reference
  std::array<double, 3> absolute{};  ///< of |picture - reference|, the reference's noise included
  std::array<double, 3> rms{};  ///< root of the mean square with the noise's taken out, 0 if nothing is left
  std::array<double, 3> noise{};  ///< root mean square of the reference's standard error
  Picture picture;                ///< |picture - reference|
};

/// Throws UsageError for pictures of different sizes.
PictureDifference difference_of(const Picture& picture, const TracedFrame& reference);

}  // namespace radiosity
