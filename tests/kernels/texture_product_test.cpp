#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/colour_texture.hpp"
#include "kernels/products.hpp"
#include "kernels/texture_products.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace radiosity {
namespace {

/// Any block of four colours; every third has a colour of code 0, some are constant.
Bc1Block random_bc1_block(RandomStream& random) {
  Bc1Block block;
  block.first = static_cast<std::uint16_t>(random.below(1U << 16));
  block.second = static_cast<std::uint16_t>(random.below(3) == 0 ? 0 : random.below(1U << 16));
  block.indices = static_cast<std::uint32_t>(random() >> 32);
  if (block.first < block.second) std::swap(block.first, block.second);
  if (block.first == block.second || random.below(9) == 0) block = {block.first, block.first, 0};
  return block;
}

ColourTexture random_texture(Index rows, Index columns, int channels, TextureCurve curve,
                             std::uint64_t seed) {
  RandomStream random(seed);
  ColourTexture texture(rows, columns, channels, curve);
  for (int channel = 0; channel < channels; ++channel) texture.set_scale(channel, 0.75 + channel);
  for (Index r = 0; r < texture.block_rows(); ++r)
    for (Index c = 0; c < texture.block_columns(); ++c) texture.set_block(r, c, random_bc1_block(random));
  return texture;
}

const std::vector<TextureCurve>& curves() {
  static const std::vector<TextureCurve> all = {{false, 1}, {true, 25}, {true, 6}};
  return all;
}

/// Columns of X and Y that belong to one matrix.
Eigen::MatrixXd columns_of(const Eigen::MatrixXd& fields, int channel, int channels) {
  Eigen::MatrixXd own(fields.rows(), fields.cols() / channels);
  for (Index light = 0; light < own.cols(); ++light) own.col(light) = fields.col(light * channels + channel);
  return own;
}

void expect_right(const ColourTexture& M, Index lights) {
  const int channels = M.channels();
  const Eigen::MatrixXd X = random_matrix(M.columns(), lights * channels, 52);
  const Eigen::MatrixXd Z = random_matrix(M.rows(), lights * channels, 53);
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(std::string(name(set)) + ", " + std::to_string(M.rows()) + " x " +
                 std::to_string(M.columns()) + ", " + std::to_string(channels) + " channels");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(M.rows(), X.cols(), nan);
    multiply(M, X, Y, set);
    Eigen::MatrixXd W = Eigen::MatrixXd::Constant(M.columns(), X.cols(), nan);
    multiply_transposed(M, Z, W, set);
    for (int c = 0; c < channels; ++c) {
      const Eigen::MatrixXd matrix = materialize(M, c);
      EXPECT_TRUE(
          within_product_bound(matrix, columns_of(X, c, channels), columns_of(Y, c, channels), 0x1p-24));
      EXPECT_TRUE(within_product_bound(matrix.transpose(), columns_of(Z, c, channels),
                                       columns_of(W, c, channels), 0x1p-24));
    }
  }
}

TEST(TextureProduct, MeetsTheBoundOfFloat) {
  for (const TextureCurve& curve : curves())
    for (const int channels : {1, 3})
      for (const Index n : hard_sizes()) expect_right(random_texture(n, n, channels, curve, 51), 1);
  expect_right(random_texture(70, 300, 3, {}, 54), 3);
  expect_right(random_texture(300, 70, 1, {}, 55), 5);
}

TEST(TextureProduct, DecodesTheBitsOfThePlainPaletteWithEveryInstructionSet) {
  constexpr Index n = 96;
  for (const TextureCurve& curve : curves())
    for (const int channels : {1, 3}) {
      ColourTexture M = random_texture(n, n, channels, curve, 56);
      for (int c = 0; c < channels; ++c) M.set_scale(c, 1);
      // One texel a row and column: sums with zeros are exact.
      Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n, n * channels);
      for (Index j = 0; j < n; ++j)
        for (int c = 0; c < channels; ++c) X(j, j * channels + c) = 1;
      for (const InstructionSet set : available_instruction_sets()) {
        Eigen::MatrixXd Y(n, X.cols());
        multiply(M, X, Y, set);
        Eigen::MatrixXd W(n, X.cols());
        multiply_transposed(M, X, W, set);
        for (int c = 0; c < channels; ++c) {
          // Linear textures may be multiplied without making texels: to rounding, and zeros as zeros.
          const bool decodes =
              curve.logarithmic || texture_products(set).linear_strip[channels == 3] == nullptr;
          const Eigen::ArrayXXd matrix = materialize(M, c).array();
          EXPECT_TRUE(
              ((columns_of(Y, c, channels).array() - matrix).abs() <= (decodes ? 0 : 0x1p-22) * matrix).all())
              << name(set);
          EXPECT_EQ(columns_of(W, c, channels), materialize(M, c).transpose()) << name(set);
        }
      }
    }
}

TEST(TextureProduct, DoesNotDependOnThreadsOrColumns) {
  const ColourTexture M = random_texture(900, 700, 3, {}, 57);
  const Eigen::MatrixXd X = random_matrix(700, 6, 58);
  const Eigen::MatrixXd Z = random_matrix(900, 6, 59);
  Eigen::MatrixXd first(900, 6);
  multiply(M, X, first);
  Eigen::MatrixXd first_transposed(700, 6);
  multiply_transposed(M, Z, first_transposed);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::MatrixXd again(900, 6);
    multiply(M, X, again);
    EXPECT_EQ(first, again) << threads;
    Eigen::MatrixXd again_transposed(700, 6);
    multiply_transposed(M, Z, again_transposed);
    EXPECT_EQ(first_transposed, again_transposed) << threads;
    Eigen::MatrixXd alone(900, 3);
    multiply(M, X.rightCols(3), alone);
    EXPECT_EQ(alone, first.rightCols(3)) << threads;
  }
}

TEST(TextureProduct, ScalesFieldsOfAnySize) {
  const ColourTexture M = random_texture(65, 65, 1, {}, 60);
  const Eigen::MatrixXd X = random_matrix(65, 1, 61);
  Eigen::MatrixXd Y(65, 1);
  multiply(M, X, Y);
  for (const double size : {0x1p-900, 0x1p300, 0x1p900}) {
    Eigen::MatrixXd scaled(65, 1);
    multiply(M, size * X, scaled);
    EXPECT_EQ(scaled, size * Y) << size;
  }
}

TEST(ColourTexture, ZerosOfTheCodeAreZerosOfTheMatrix) {
  for (const TextureCurve& curve : curves()) {
    ColourTexture texture(4, 4, 3, curve);
    EXPECT_EQ(materialize(texture, 0), Eigen::MatrixXd::Zero(4, 4));
    // Red between code 0 and 8; green and blue are 0.
    texture.set_block(0, 0, {static_cast<std::uint16_t>(8 << 11), 0, 0xe4e4e4e4});
    for (Index r = 0; r < 4; ++r) {
      EXPECT_GT(texture(r, 0, 0), 0);
      EXPECT_EQ(texture(r, 1, 0), 0);
      EXPECT_EQ(texture(r, 0, 1), 0);
      EXPECT_EQ(texture(r, 2, 2), 0);
      EXPECT_LT(texture(r, 2, 0), texture(r, 0, 0));
    }
  }
}

TEST(ColourTexture, StandsForDocument000sMap) {
  ColourTexture texture(4, 4, 3, {true, 25});
  texture.set_scale(1, 2);
  texture.set_block(0, 0, {static_cast<std::uint16_t>(42 << 5), static_cast<std::uint16_t>(21 << 5), 0xe4});
  const auto value = [](double code) { return 2 * std::exp(code / 255 * 25 - 25); };
  const double high = 255.0 * 42 / 63;
  const double low = 255.0 * 21 / 63;
  EXPECT_NEAR(texture(0, 0, 1) / value(high), 1, 1e-6);
  EXPECT_NEAR(texture(0, 1, 1) / value(low), 1, 1e-6);
  EXPECT_NEAR(texture(0, 2, 1) / value((2 * high + low) / 3), 1, 1e-6);
  EXPECT_NEAR(texture(0, 3, 1) / value((high + 2 * low) / 3), 1, 1e-6);
}

TEST(ColourTexture, RefusesWhatItsProductsCannotRead) {
  EXPECT_THROW(ColourTexture(4, 4, 2, {}), UsageError);
  EXPECT_THROW(ColourTexture(4, 4, 3, {true, 0}), UsageError);
  EXPECT_THROW(ColourTexture(4, 4, 3, {true, 81}), UsageError);
  ColourTexture texture(4, 4, 3, {});
  EXPECT_THROW(texture.set_block(0, 0, {1, 2, 0}), UsageError);
  EXPECT_THROW(texture.set_block(0, 0, {2, 2, 3}), UsageError);
  Eigen::MatrixXd Y(4, 2);
  EXPECT_THROW(multiply(texture, Eigen::MatrixXd::Ones(4, 2), Y), UsageError);
  EXPECT_THROW(multiply_transposed(texture, Eigen::MatrixXd::Ones(5, 3), Y), UsageError);
}

}  // namespace
}  // namespace radiosity
