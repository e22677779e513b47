#include "frame/picture_difference.hpp"

#include "foundation/error.hpp"

#include <cmath>

namespace radiosity {

PictureDifference difference_of(const Picture& picture, const Picture& reference) {
  if (picture.width != reference.width || picture.height != reference.height)
    fail<UsageError>("pictures of {} x {} and {} x {} pixels cannot be compared", picture.width,
                     picture.height, reference.width, reference.height);
  PictureDifference result;
  result.picture = {picture.width, picture.height, std::vector<float>(picture.pixels.size())};
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < picture.pixels.size(); ++k) {
    const double difference =
        static_cast<double>(picture.pixels[k]) - static_cast<double>(reference.pixels[k]);
    result.mean[k % 3] += difference;
    result.absolute[k % 3] += std::fabs(difference);
    sum[k % 3] += static_cast<double>(reference.pixels[k]);
    result.picture.pixels[k] = static_cast<float>(std::fabs(difference));
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double whole = sum[c] > 0 ? sum[c] : 1;
    result.mean[c] /= whole;
    result.absolute[c] /= whole;
  }
  return result;
}

}  // namespace radiosity
