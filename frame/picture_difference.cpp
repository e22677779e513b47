#include "frame/picture_difference.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

PictureDifference difference_of(const Picture& picture, const TracedFrame& reference) {
  const Picture& traced = reference.picture;
  if (picture.width != traced.width || picture.height != traced.height)
    fail<UsageError>("pictures of {} x {} and {} x {} pixels cannot be compared", picture.width,
                     picture.height, traced.width, traced.height);
  PictureDifference result;
  result.picture = {picture.width, picture.height, std::vector<float>(picture.pixels.size())};
  std::array<double, 3> sum{};
  std::array<double, 3> squares{};
  std::array<double, 3> noise{};
  for (std::size_t k = 0; k < picture.pixels.size(); ++k) {
    const double difference = static_cast<double>(picture.pixels[k]) - static_cast<double>(traced.pixels[k]);
    const auto error = static_cast<double>(reference.standard_error.pixels[k]);
    result.mean[k % 3] += difference;
    result.absolute[k % 3] += std::fabs(difference);
    squares[k % 3] += difference * difference;
    noise[k % 3] += error * error;
    sum[k % 3] += static_cast<double>(traced.pixels[k]);
    result.picture.pixels[k] = static_cast<float>(std::fabs(difference));
  }
  const double pixels = static_cast<double>(picture.pixels.size()) / 3;
  for (std::size_t c = 0; c < 3; ++c) {
    const double whole = sum[c] > 0 ? sum[c] : 1;
    result.mean[c] /= whole;
    result.absolute[c] /= whole;
    result.rms[c] = std::sqrt(std::max(0.0, squares[c] - noise[c]) * pixels) / whole;
    result.noise[c] = std::sqrt(noise[c] * pixels) / whole;
  }
  return result;
}

}  // namespace radiosity
