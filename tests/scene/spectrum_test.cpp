#include "scene/cornell_spectra.hpp"
#include "scene/spectrum.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

TEST(Spectrum, KeepsFlatSpectraNeutral) {
  MeasuredSpectrum flat;
  flat.fill(0.78);
  EXPECT_LT((linear_srgb(flat) - 0.78).abs().maxCoeff(), 1e-12);
}

TEST(Spectrum, IsLinear) {
  MeasuredSpectrum sum = cornell_red();
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 2 * sum[i] + cornell_green()[i];
  EXPECT_LT(
      (linear_srgb(sum) - 2 * linear_srgb(cornell_red()) - linear_srgb(cornell_green())).abs().maxCoeff(),
      1e-14);
}

// Unweighted means as published with the measurement; a slip in copying the numbers would show.
TEST(Spectrum, HasThePublishedMeans) {
  const auto mean = [](const MeasuredSpectrum& spectrum) {
    double sum = 0;
    for (const double value : spectrum) sum += value;
    return sum / static_cast<double>(spectrum.size());
  };
  EXPECT_NEAR(mean(cornell_white()), 0.7227, 5e-5);
  EXPECT_NEAR(mean(cornell_green()), 0.1983, 5e-5);
  EXPECT_NEAR(mean(cornell_red()), 0.2429, 5e-5);
}

TEST(Spectrum, OfTheLightPassesThroughThePublishedPoints) {
  EXPECT_EQ(cornell_light()[0], 0.0);
  EXPECT_EQ(cornell_light()[25], 8.0);
  EXPECT_EQ(cornell_light()[50], 15.6);
  EXPECT_EQ(cornell_light()[75], 18.4);
}

}  // namespace
}  // namespace radiosity
