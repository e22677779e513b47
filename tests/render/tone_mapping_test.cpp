#include "render/tone_mapping.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace radiosity {
namespace {

TEST(ToneMapping, IsWhatItSays) {
  EXPECT_EQ(srgb_byte(0), 0);
  EXPECT_EQ(srgb_byte(1), 255);
  EXPECT_EQ(srgb_byte(7), 255);
  EXPECT_EQ(srgb_byte(-1), 0);
  EXPECT_EQ(srgb_byte(0.2122), 127);
  EXPECT_EQ(srgb_byte(0.2159), 128);
  EXPECT_NEAR(srgb_from_linear(0.0031308), 0.04045, 1e-5);

  Picture picture{10, 10, std::vector<float>(300, 0.F)};
  for (std::size_t k = 0; k < 40; ++k)  // 40 lit pixels of radiance 1 to 40; black ones do not count
    for (std::size_t c = 0; c < 3; ++c) picture.pixels[3 * k + c] = static_cast<float>(k + 1);
  EXPECT_NEAR(exposure_of(picture), exposure_target / 38, 1e-6);
  EXPECT_EQ(exposure_of(Picture{1, 1, {0, 0, 0}}), 1);

  // Patches count by area: the bright one is too small to matter.
  const Eigen::MatrixXd B = Eigen::Vector2d(std::numbers::pi, 100 * std::numbers::pi);
  EXPECT_NEAR(exposure_of(B, Eigen::Vector2d(99, 1)), exposure_target, 1e-12);
  EXPECT_NEAR(exposure_of(B, Eigen::Vector2d(90, 10)), exposure_target / 100, 1e-12);
}

}  // namespace
}  // namespace radiosity
