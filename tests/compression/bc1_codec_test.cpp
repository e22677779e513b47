#include "block_patterns.hpp"
#include "compression/bc1_codec.hpp"
#include "foundation/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

constexpr std::array<Bc1Fit, 2> both_fits = {Bc1Fit::range, Bc1Fit::cluster};
constexpr std::array<double, 3> half_a_step = {255.0 / 62, 255.0 / 126, 255.0 / 62};

double decoded(const Bc1Block& block, int texel, std::size_t channel) {
  return bc1_palette(block)[static_cast<std::size_t>(bc1_index(block, texel))][channel];
}

Bc1Texels grey(const Texels& code) {
  Bc1Texels texels;
  texels.code = {code, code, code};
  return texels;
}

Bc1Texels green(const Texels& code) {
  Bc1Texels texels;
  texels.code[1] = code;
  return texels;
}

/// Three channels that share most of what they do.
Bc1Texels random_texels(RandomStream& random) {
  Bc1Texels texels;
  const Texels shared = random_codes(random);
  for (Texels& code : texels.code) {
    const double offset = random.uniform(-30, 30);
    for (int t = 0; t < 16; ++t) code[t] = shared[t] + static_cast<float>(offset + random.uniform(-5, 5));
    code = code.max(0).min(255).round();
  }
  return texels;
}

bool has_four_colours(const Bc1Block& block) {
  return block.first > block.second || (block.first == block.second && block.indices == 0);
}

/// The least error that any block of 64 x 64 green ends can have.
double least_green_error(const Bc1Texels& texels) {
  double least = std::numeric_limits<double>::infinity();
  for (int first = 0; first < 64; ++first)
    for (int second = 0; second <= first; ++second) {
      const Bc1Palette palette =
          bc1_palette({static_cast<std::uint16_t>(first << 5), static_cast<std::uint16_t>(second << 5), 0});
      double sum = 0;
      for (int t = 0; t < 16 && sum < least; ++t) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < (first > second ? 4U : 1U); ++k)
          nearest = std::min(nearest, std::abs(static_cast<double>(texels.code[1][t]) - palette[k][1]));
        sum += static_cast<double>(texels.weight[t]) * nearest * nearest;
      }
      least = std::min(least, sum);
    }
  return least;
}

TEST(Bc1Codec, MeetsEveryPatternWithFourColours) {
  for (const BlockPattern& pattern : block_patterns())
    for (const Bc1Texels& texels : {grey(pattern.code), green(pattern.code)})
      for (const Bc1Fit fit : both_fits) {
        SCOPED_TRACE(pattern.name + (fit == Bc1Fit::range ? ", range" : ", cluster"));
        const Bc1Block block = encode_bc1(texels, fit);
        EXPECT_TRUE(has_four_colours(block));
        // Four colours at equal distances: half of them beside the roundings of the ends.
        const double spread = static_cast<double>(pattern.code.maxCoeff() - pattern.code.minCoeff());
        for (std::size_t c = 0; c < 3; ++c)
          for (int t = 0; t < 16; ++t) {
            const double error = std::abs(decoded(block, t, c) - static_cast<double>(texels.code[c][t]));
            if (spread < 1e-6) {
              EXPECT_LE(error, half_a_step[c] + 1e-4);
            }
            if (fit == Bc1Fit::range) {
              EXPECT_LE(error, spread / 6 + 2 * half_a_step[c]);
            }
          }
      }
}

TEST(Bc1Codec, KeepsZerosOfBlocksThatHaveNothingElse) {
  Bc1Texels texels;
  texels.code[0][3] = 200;
  texels.weight[3] = 0;
  for (const Bc1Fit fit : both_fits) {
    EXPECT_EQ(encode_bc1(Bc1Texels{}, fit), Bc1Block{});
    EXPECT_EQ(encode_bc1(grey(Texels::Constant(1e-42F)), fit), Bc1Block{});
    EXPECT_EQ(squared_error(texels, encode_bc1(texels, fit)), 0) << "a free texel beside zeros";
    texels.weight.setZero();
    EXPECT_EQ(encode_bc1(texels, fit), Bc1Block{}) << "all texels free";
    texels.weight.setOnes();
    texels.weight[3] = 0;
  }
}

TEST(Bc1Codec, GivesBackWhatABlockHolds) {
  RandomStream random(11);
  for (int trial = 0; trial < 200; ++trial) {
    Bc1Block block{static_cast<std::uint16_t>(random.below(65536)),
                   static_cast<std::uint16_t>(random.below(65536)), static_cast<std::uint32_t>(random())};
    if (block.first == block.second) continue;
    if (block.first < block.second) std::swap(block.first, block.second);
    block.indices = (block.indices & ~0xfU) | 4U;  // both ends occur
    Bc1Texels texels;
    for (std::size_t c = 0; c < 3; ++c)
      for (int t = 0; t < 16; ++t) texels.code[c][t] = static_cast<float>(decoded(block, t, c));
    for (const Bc1Fit fit : both_fits) EXPECT_LT(squared_error(texels, encode_bc1(texels, fit)), 1e-6);
  }
}

TEST(Bc1Codec, ClusterIsNeverWorseThanRange) {
  RandomStream random(1);
  double range = 0, cluster = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Bc1Texels texels = random_texels(random);
    if (trial % 3 == 0)
      for (float& weight : texels.weight) weight = random.uniform() < 0.2 ? 0 : 1;
    if (trial % 5 == 0)
      for (Texels& code : texels.code) code[static_cast<Eigen::Index>(random.below(16))] = 0;
    const Bc1Block of_range = encode_bc1(texels, Bc1Fit::range);
    const Bc1Block of_cluster = encode_bc1(texels, Bc1Fit::cluster);
    EXPECT_TRUE(has_four_colours(of_range) && has_four_colours(of_cluster));
    EXPECT_LE(squared_error(texels, of_cluster), squared_error(texels, of_range));
    range += squared_error(texels, of_range);
    cluster += squared_error(texels, of_cluster);
  }
  EXPECT_LT(cluster, 0.6 * range);
}

TEST(Bc1Codec, ClusterIsNearTheBestOfAllGreenBlocks) {
  RandomStream random(2);
  double least = 0, cluster = 0, range = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Bc1Texels texels = green(random_codes(random));
    const double best = least_green_error(texels);
    const double reached = squared_error(texels, encode_bc1(texels, Bc1Fit::cluster));
    EXPECT_GE(reached, best - 1e-6);
    least += best;
    cluster += reached;
    range += squared_error(texels, encode_bc1(texels, Bc1Fit::range));
  }
  EXPECT_LT(cluster, 1.1 * least);
  EXPECT_GT(range, 1.1 * least) << "the bound above tells the two fits apart";
}

TEST(Bc1Codec, AnErrorCountsAsItsWeight) {
  Bc1Texels texels = grey(Texels::LinSpaced(40, 200));
  const Bc1Block even = encode_bc1(texels, Bc1Fit::cluster);
  texels.weight[7] = 1e4F;
  const Bc1Block favoured = encode_bc1(texels, Bc1Fit::cluster);
  const auto error = [&](const Bc1Block& block) {
    return std::abs(decoded(block, 7, 1) - static_cast<double>(texels.code[1][7]));
  };
  EXPECT_LT(error(favoured), error(even) / 4);
  // What lies in a free texel costs the others nothing.
  texels = grey(Texels::LinSpaced(100, 130));
  for (Texels& code : texels.code) code[5] = 255;
  texels.weight[5] = 0;
  const double beside_free = squared_error(texels, encode_bc1(texels, Bc1Fit::cluster));
  texels.weight[5] = 1;
  EXPECT_LT(beside_free, squared_error(texels, encode_bc1(texels, Bc1Fit::cluster)) / 4);
}

TEST(Bc1Codec, ExchangedEndsMeanOtherColours) {
  const Bc1Texels texels = grey(Texels::LinSpaced(0, 255));
  Bc1Block block = encode_bc1(texels, Bc1Fit::range);
  const double error = squared_error(texels, block);
  std::swap(block.first, block.second);
  EXPECT_FALSE(has_four_colours(block));
  EXPECT_GT(squared_error(texels, block), 10 * error);
}

TEST(Bc1Codec, RefusesWhatIsNoCode) {
  for (const float wrong : {-1.0F, 255.5F, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    Bc1Texels texels;
    texels.code[2][9] = wrong;
    EXPECT_THROW(encode_bc1(texels, Bc1Fit::range), UsageError) << wrong;
  }
  Bc1Texels texels;
  texels.weight[1] = -1;
  EXPECT_THROW(encode_bc1(texels, Bc1Fit::range), UsageError);
  texels.weight[1] = std::nanf("");
  EXPECT_THROW(encode_bc1(texels, Bc1Fit::cluster), UsageError);
}

}  // namespace
}  // namespace radiosity
