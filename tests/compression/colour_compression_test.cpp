// C1 and C2 of the hard cases: what whole matrices lose when they are compressed, and orders that change
// nothing.

#include "compression/colour_compression.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace radiosity {
namespace {

const std::vector<TexelCodec>& codecs() {
  static const std::vector<TexelCodec> all = {TexelCodec::bc1, TexelCodec::bc4, TexelCodec::u8,
                                              TexelCodec::u4,  TexelCodec::f16, TexelCodec::bf16};
  return all;
}

std::vector<Index> sequence(Index n) {
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<Index> shuffled(Index n, std::uint64_t seed) {
  std::vector<Index> order = sequence(n);
  RandomStream random(seed);
  for (std::size_t left = order.size(); left > 1; --left)
    std::swap(order[left - 1], order[random.below(left)]);
  return order;
}

TexelOrder fixed(std::vector<Index> order) {
  return [order = std::move(order)](std::span<const CodeMatrix>) { return order; };
}

/// Smooth over four decades, with zeros where rows and columns belong together.
ColourMatrix smooth_matrix(Index n, double colour = 1) {
  ColourMatrix matrix(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double distance = 0.03 + std::fabs(static_cast<double>(i - j)) / static_cast<double>(n);
      matrix(i, j) = i * 6 / n == j * 6 / n ? 0.0F : static_cast<float>(colour / (distance * distance));
    }
  return matrix;
}

ColourMatrix constant_matrix(Index n, float value) {
  return ColourMatrix::Constant(n, n, value);
}

std::vector<ColourMatrix> three(const ColourMatrix& matrix) {
  return {matrix, 0.5F * matrix, 0.1F * matrix};
}

Eigen::MatrixXd truth_of(const ColourMatrix& matrix) {
  return matrix.cast<double>();
}

double relative_error(const CompressedColours& compressed, const std::vector<ColourMatrix>& matrices) {
  double error = 0, norm = 0;
  for (std::size_t c = 0; c < matrices.size(); ++c) {
    error += (compressed.materialize(static_cast<Index>(c)) - truth_of(matrices[c])).squaredNorm();
    norm += truth_of(matrices[c]).squaredNorm();
  }
  return std::sqrt(error / norm);
}

TEST(ColourCompression, ZerosStayZeroInEveryCodec) {
  for (const TexelCodec codec : codecs())
    for (const bool fill : {false, true}) {
      const std::vector<ColourMatrix> zero = three(constant_matrix(37, 0));
      const CompressedColours compressed =
          compress_colours(zero, {.codec = codec, .fill = fill}, fixed(sequence(37)));
      for (Index c = 0; c < 3; ++c)
        EXPECT_EQ(compressed.materialize(c), Eigen::MatrixXd::Zero(37, 37)) << static_cast<int>(codec);
    }
}

TEST(ColourCompression, ConstantsAreMetWithinHalfAStep) {
  for (const TexelCodec codec : codecs())
    for (const float value : {1.0F, 3e-7F, 2e20F, 1e-38F}) {
      const std::vector<ColourMatrix> matrices = three(constant_matrix(33, value));
      const CompressedColours compressed =
          compress_colours(matrices, {.codec = codec, .exact = 0}, fixed(sequence(33)));
      EXPECT_LE(relative_error(compressed, matrices), 2e-3) << static_cast<int>(codec) << " " << value;
    }
}

TEST(ColourCompression, SpikesAndMasksAndNoiseAreNeverNegative) {
  RandomStream random(3);
  ColourMatrix spike = constant_matrix(40, 1e-6F), mask = spike, noise = spike, subnormal = spike;
  spike(7, 9) = 1;
  for (Index i = 0; i < 40; ++i)
    for (Index j = 0; j < 40; ++j) {
      mask(i, j) = random.uniform() < 0.5 ? 0.0F : 1.0F;
      noise(i, j) = static_cast<float>(random.uniform());
      subnormal(i, j) = static_cast<float>(random.uniform(0, 1e-40));
    }
  for (const TexelCodec codec : codecs())
    for (const ColourMatrix& matrix : {spike, mask, noise, subnormal})
      for (const bool fill : {false, true}) {
        const CompressedColours compressed = compress_colours(
            three(matrix), {.codec = codec, .range = 0, .exact = 0.05, .fill = fill}, fixed(shuffled(40, 4)));
        for (Index c = 0; c < 3; ++c) {
          const Eigen::MatrixXd decoded = compressed.materialize(c);
          EXPECT_TRUE(decoded.allFinite());
          // Filled texels are taken off again: rounding may leave the last bit of float.
          EXPECT_GE(decoded.minCoeff(), -1e-6 * decoded.maxCoeff()) << static_cast<int>(codec);
        }
      }
}

TEST(ColourCompression, SmoothMatricesLoseLittle) {
  const std::vector<ColourMatrix> matrices = three(smooth_matrix(120));
  const auto error = [&](TexelCodec codec, bool fill) {
    return relative_error(
        compress_colours(matrices, {.codec = codec, .range = 0, .fill = fill}, fixed(sequence(120))),
        matrices);
  };
  EXPECT_LE(error(TexelCodec::f16, true), 5e-4);
  EXPECT_LE(error(TexelCodec::bf16, true), 4e-3);
  EXPECT_LE(error(TexelCodec::u8, true), 1e-2);
  EXPECT_LE(error(TexelCodec::bc4, true), 0.05);
  EXPECT_LE(error(TexelCodec::bc1, true), 0.12);
  // Zeros in place of exact entries spoil their blocks.
  EXPECT_GT(error(TexelCodec::bc1, false), error(TexelCodec::bc1, true));
}

TEST(ColourCompression, ExactEntriesAreExact) {
  const std::vector<ColourMatrix> matrices = {smooth_matrix(60)};
  for (const TexelCodec codec : codecs())
    for (const bool fill : {false, true}) {
      const Eigen::MatrixXd decoded =
          compress_colours(matrices, {.codec = codec, .exact = 1, .fill = fill}, fixed(shuffled(60, 5)))
              .materialize(0);
      EXPECT_LE((decoded - truth_of(matrices[0])).norm(), 1e-6 * decoded.norm()) << static_cast<int>(codec);
    }
}

TEST(ColourCompression, OrdersChangeNothingWhereNothingIsLost) {
  // C2: with all entries exact in tiles, P'(P M P')P is M to the last bit.
  const std::vector<ColourMatrix> matrices = {smooth_matrix(130)};
  for (const TexelCodec codec : {TexelCodec::u8, TexelCodec::bf16}) {
    const ColourCompressionOptions options{.codec = codec, .exact = 0};
    const Eigen::MatrixXd in_order = compress_colours(matrices, options, fixed(sequence(130))).materialize(0);
    const Eigen::MatrixXd reordered =
        compress_colours(matrices, options, fixed(shuffled(130, 6))).materialize(0);
    EXPECT_EQ(in_order, reordered);
  }
}

TEST(ColourCompression, ProductsAreThoseOfTheirMatrices) {
  const std::vector<ColourMatrix> matrices = three(smooth_matrix(90));
  RandomStream random(7);
  Eigen::MatrixXd X(90, 6);
  for (Index j = 0; j < 6; ++j)
    for (Index i = 0; i < 90; ++i) X(i, j) = random.uniform(-1, 1);
  for (const TexelCodec codec : codecs()) {
    const CompressedColours compressed =
        compress_colours(matrices, {.codec = codec, .fill = true}, fixed(shuffled(90, 8)));
    Eigen::MatrixXd Y(90, 6), Z(90, 6);
    compressed.multiply(X, Y);
    compressed.multiply_transposed(X, Z);
    for (Index j = 0; j < 6; ++j) {
      const Eigen::MatrixXd M = compressed.materialize(j % 3);
      EXPECT_LE((Y.col(j) - M * X.col(j)).norm(), 1e-5 * M.norm() * X.col(j).norm());
      EXPECT_LE((Z.col(j) - M.transpose() * X.col(j)).norm(), 1e-5 * M.norm() * X.col(j).norm());
    }
  }
}

TEST(ColourCompression, KernelsStaySymmetric) {
  ColourMatrix kernel = smooth_matrix(150);
  for (const TexelCodec codec : {TexelCodec::bc4, TexelCodec::u8, TexelCodec::u4, TexelCodec::f16})
    for (const bool fill : {false, true}) {
      const CompressedKernel compressed =
          compress_kernel(kernel, {.codec = codec, .range = 0, .fill = fill}, fixed(shuffled(150, 9)));
      const Eigen::MatrixXd own = materialize(compressed.tiles);
      EXPECT_EQ(own, own.transpose()) << static_cast<int>(codec);
      Eigen::MatrixXd decoded(150, 150);
      decoded(compressed.order, compressed.order) = own;
      EXPECT_LE((decoded - truth_of(kernel)).norm(), 0.15 * truth_of(kernel).norm())
          << static_cast<int>(codec);
      // 4 % of n^2, both halves, and no more.
      EXPECT_EQ(compressed.tiles.exact_value().empty(), false);
    }
  EXPECT_THROW(compress_kernel(kernel, {.codec = TexelCodec::bc1}, fixed(sequence(150))), UsageError);
  kernel(3, 4) = kernel(4, 3) = -1;
  EXPECT_THROW(compress_kernel(kernel, {.codec = TexelCodec::u8}, fixed(sequence(150))), Error);
}

TEST(ColourCompression, DoesNotDependOnThreads) {
  const std::vector<ColourMatrix> matrices = three(smooth_matrix(140));
  const auto compress = [&] {
    return compress_colours(matrices, {.range = 0, .fill = true}, fixed(shuffled(140, 10)));
  };
  const CompressedColours first = compress();
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    const CompressedColours again = compress();
    for (Index c = 0; c < 3; ++c) EXPECT_EQ(first.materialize(c), again.materialize(c));
  }
}

TEST(ColourCompression, RefusesWhatIsNoMatrixOfNumbers) {
  ColourMatrix matrix = smooth_matrix(20);
  EXPECT_THROW(compress_colours({&matrix, 1}, {.range = 200}, fixed(sequence(20))), UsageError);
  EXPECT_THROW(compress_colours({&matrix, 1}, {.exact = 1.5}, fixed(sequence(20))), UsageError);
  matrix(1, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(compress_colours({&matrix, 1}, {}, fixed(sequence(20))), Error);
}

}  // namespace
}  // namespace radiosity
