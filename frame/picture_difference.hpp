#pragma once

#include "render/picture.hpp"

#include <array>

namespace radiosity {

/// How a picture differs from a reference, channel by channel (red, green, blue), relative to the mean of the
/// reference in that channel; 0 in channels that are black in both.
struct PictureDifference {
  std::array<double, 3> mean{};      ///< of picture - reference
  std::array<double, 3> absolute{};  ///< of |picture - reference|
  Picture picture;                   ///< |picture - reference|
};

/// Throws UsageError for pictures of different sizes.
PictureDifference difference_of(const Picture& picture, const Picture& reference);

}  // namespace radiosity
