#include "render/tone_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace radiosity {
namespace {

double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/// The exposure that maps the percentile of (luminance, weight) pairs to its target.
double exposure_for(std::vector<std::pair<double, double>> lit) {
  double total = 0;
  for (const auto& [value, weight] : lit) total += weight;
  std::sort(lit.begin(), lit.end());
  double below = 0;
  for (const auto& [value, weight] : lit) {
    below += weight;
    if (below >= exposure_percentile * total) return exposure_target / value;
  }
  return 1;  // nothing is lit
}

}  // namespace

double exposure_of(const Picture& picture) {
  std::vector<std::pair<double, double>> lit;
  for (std::size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
    const double value = luminance(picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]);
    if (value > 0) lit.emplace_back(value, 1.0);
  }
  return exposure_for(std::move(lit));
}

double exposure_of(const Eigen::MatrixXd& B, const Eigen::VectorXd& area) {
  std::vector<std::pair<double, double>> lit;
  for (Eigen::Index i = 0; i < B.rows(); ++i) {
    const double value = B.cols() == 3 ? luminance(B(i, 0), B(i, 1), B(i, 2)) : B(i, 0);
    if (value > 0) lit.emplace_back(value / std::numbers::pi, area[i]);
  }
  return exposure_for(std::move(lit));
}

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::uint8_t srgb_byte(double exposed) {
  return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(exposed, 0.0, 1.0))));
}

std::vector<std::uint8_t> tone_mapped(const Picture& picture, double exposure) {
  std::vector<std::uint8_t> bytes(picture.pixels.size());
  std::transform(picture.pixels.begin(), picture.pixels.end(), bytes.begin(),
                 [exposure](float value) { return srgb_byte(exposure * value); });
  return bytes;
}

}  // namespace radiosity
