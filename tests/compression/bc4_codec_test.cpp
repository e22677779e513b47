#include "block_patterns.hpp"
#include "compression/bc4_codec.hpp"
#include "foundation/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

double decoded(const Bc4Block& block, int texel) {
  return bc4_palette(block)[static_cast<std::size_t>(bc4_index(block, texel))];
}

/// The least error that any block of the given mode can have.
double least_error(const Texels& code, bool eight) {
  double least = std::numeric_limits<double>::infinity();
  for (int first = 0; first < 256; ++first)
    for (int second = 0; second <= first; ++second) {
      const auto high = static_cast<std::uint8_t>(first), low = static_cast<std::uint8_t>(second);
      const std::array<double, 8> palette =
          bc4_palette(eight ? Bc4Block{high, low, {}} : Bc4Block{low, high, {}});
      double sum = 0;
      for (int t = 0; t < 16 && sum < least; ++t) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const double number : palette)
          nearest = std::min(nearest, std::abs(static_cast<double>(code[t]) - number));
        sum += nearest * nearest;
      }
      least = std::min(least, sum);
    }
  return least;
}

TEST(Bc4Codec, MeetsEveryPattern) {
  for (const BlockPattern& pattern : block_patterns()) {
    SCOPED_TRACE(pattern.name);
    const Bc4Block block = encode_bc4({.code = pattern.code});
    const double spread = static_cast<double>(pattern.code.maxCoeff() - pattern.code.minCoeff());
    double squares = 0;
    for (int t = 0; t < 16; ++t) {
      const double error = std::abs(decoded(block, t) - static_cast<double>(pattern.code[t]));
      squares += error * error;
      if (spread < 1e-6) {
        EXPECT_LE(error, 0.5);
      }
    }
    // Between the outermost codes themselves every texel is met within half of a seventh and a rounding.
    EXPECT_LE(squares, 16 * std::pow(spread / 14 + 0.5, 2));
  }
}

TEST(Bc4Codec, KeepsZerosAndFreeTexels) {
  EXPECT_EQ(encode_bc4({}), Bc4Block{});
  EXPECT_EQ(encode_bc4({.code = Texels::Constant(1e-42F)}), Bc4Block{});
  Bc4Texels texels;
  texels.code[3] = 200;
  texels.weight[3] = 0;
  EXPECT_EQ(squared_error(texels, encode_bc4(texels)), 0) << "a free texel beside zeros";
  texels.weight.setZero();
  EXPECT_EQ(encode_bc4(texels), Bc4Block{}) << "all texels free";
}

TEST(Bc4Codec, ZerosAmongOtherCodesStayExact) {
  Bc4Texels texels{.code = Texels::LinSpaced(180, 190)};
  texels.code[2] = texels.code[8] = 0;
  const Bc4Block block = encode_bc4(texels);
  EXPECT_LE(block.first, block.second) << "six levels beside 0 and 255";
  EXPECT_EQ(decoded(block, 2), 0);
  EXPECT_EQ(decoded(block, 8), 0);
  EXPECT_LT(squared_error(texels, block), 14 * 1.0);
}

TEST(Bc4Codec, GivesBackWhatABlockHolds) {
  RandomStream random(12);
  for (int trial = 0; trial < 200; ++trial) {
    Bc4Block block{static_cast<std::uint8_t>(1 + random.below(254)),
                   static_cast<std::uint8_t>(1 + random.below(254)),
                   {}};
    for (std::uint8_t& byte : block.indices) byte = static_cast<std::uint8_t>(random.below(256));
    set_bc4_index(block, 0, 0);
    set_bc4_index(block, 1, 1);
    Bc4Texels texels;
    for (int t = 0; t < 16; ++t) texels.code[t] = static_cast<float>(decoded(block, t));
    EXPECT_LT(squared_error(texels, encode_bc4(texels)), 1e-6) << trial;
  }
}

TEST(Bc4Codec, IsNearTheBestOfAllBlocks) {
  RandomStream random(3);
  double least = 0, reached = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Bc4Texels texels{.code = random_codes(random)};
    if (trial % 3 == 0) texels.code[4] = texels.code[9] = 0;
    const double best = std::min(least_error(texels.code, true), least_error(texels.code, false));
    const double error = squared_error(texels, encode_bc4(texels));
    EXPECT_GE(error, best - 1e-6);
    least += best;
    reached += error;
  }
  EXPECT_LT(reached, 1.2 * least);
}

TEST(Bc4Codec, ExchangedEndsMeanOtherNumbers) {
  const Bc4Texels texels{.code = Texels::LinSpaced(10, 240)};
  Bc4Block block = encode_bc4(texels);
  EXPECT_GT(block.first, block.second);
  const double error = squared_error(texels, block);
  std::swap(block.first, block.second);
  EXPECT_GT(squared_error(texels, block), 10 * error);
}

TEST(Bc4Codec, RefusesWhatIsNoCode) {
  for (const float wrong : {-1.0F, 255.5F, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    Bc4Texels texels;
    texels.code[9] = wrong;
    EXPECT_THROW(encode_bc4(texels), UsageError) << wrong;
  }
  Bc4Texels texels;
  texels.weight[1] = -1;
  EXPECT_THROW(encode_bc4(texels), UsageError);
}

}  // namespace
}  // namespace radiosity
