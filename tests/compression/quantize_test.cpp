#include "compression/keep_largest.hpp"
#include "compression/quantize.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace radiosity {
namespace {

SymmetricTiles<double> tiles_with(Index n, const std::function<double(Index, Index)>& entry) {
  SymmetricTiles<double> tiles(n, [](Index, Index) { return true; });
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i <= j; ++i) tiles.set(i, j, entry(i, j));
  return tiles;
}

/// Falls off with distance as form factors do, with a third of zeros.
SymmetricTiles<double> falling_kernel(Index n) {
  return tiles_with(n, [n](Index i, Index j) {
    if ((i / 7 + j / 7) % 3 == 0) return 0.0;
    const double distance = static_cast<double>(j - i) / static_cast<double>(n) + 0.02;
    return 1e-3 / (distance * distance);
  });
}

QuantizedTiles quantized(const SymmetricTiles<double>& K, const QuantizeOptions& options) {
  return quantize(K, Eigen::VectorXd::Ones(K.size()), options);
}

/// The largest entry that each block of a row has beside what is kept apart bounds the error of its entries
/// by half a step, 2^-11 of it for the step's own rounding.
double half_step(double largest, int bits) {
  return largest / ((1 << bits) - 1) / 2 * (1 + 0x1p-9);
}

TEST(Quantize, MeetsHalfAStepOnEveryPattern) {
  struct Pattern {
    std::string name;
    std::function<double(Index, Index)> entry;
    double largest;
  };
  const std::vector<Pattern> patterns = {
      {"zeros", [](Index, Index) { return 0.0; }, 0},
      {"constant", [](Index, Index) { return 0.37; }, 0.37},
      {"ramp", [](Index i, Index j) { return 1e-4 * static_cast<double>(i + j); }, 2e-2},
      {"mask", [](Index i, Index j) { return (i * 5 + j * 5) % 3 == 0 ? 1.0 : 0.0; }, 1},
      {"noise",
       [](Index i, Index j) {
         return RandomStream(static_cast<std::uint64_t>(i * 1000 + j)).uniform(0, 1e-3);
       },
       1e-3},
      {"spike", [](Index i, Index j) { return i == 5 && j == 70 ? 0.5 : 1e-5; }, 0.5},
      {"subnormal", [](Index i, Index j) { return static_cast<double>(i + j) * 5e-324; }, 1e-320}};
  for (const Pattern& pattern : patterns)
    for (const int bits : {2, 4, 8})
      for (const int block : {16, 32, 64}) {
        SCOPED_TRACE(pattern.name + ", bits " + std::to_string(bits) + ", block " + std::to_string(block));
        const SymmetricTiles<double> K = tiles_with(100, pattern.entry);
        const Eigen::MatrixXd truth = materialize(K);
        const Eigen::MatrixXd coded =
            materialize(quantized(K, {.bits = bits, .block = block, .exact = 0, .diffusion = false}));
        EXPECT_GE(coded.minCoeff(), 0);
        EXPECT_TRUE(((truth.array() > 0) || (coded.array() == 0)).all());
        Eigen::MatrixXd error = (coded - truth).cwiseAbs();
        error.diagonal() /= 2;  // kept halved
        EXPECT_LE(error.maxCoeff(), std::max(half_step(pattern.largest, bits), 1e-307));
        EXPECT_EQ(coded, coded.transpose());
      }
}

TEST(Quantize, KeepsASpikeApartSoThatItsNeighboursKeepTheirDigits) {
  const SymmetricTiles<double> K =
      tiles_with(100, [](Index i, Index j) { return i == 5 && j == 70 ? 0.5 : 1e-5; });
  const QuantizedTiles coded = quantized(K, {.exact = 0.001, .diffusion = false});
  Eigen::MatrixXd error = materialize(coded) - materialize(K);
  EXPECT_EQ(error(5, 70), 0);
  error.diagonal() /= 2;  // kept halved
  EXPECT_LE(error.cwiseAbs().maxCoeff(), half_step(1e-5, 4));
  const Eigen::MatrixXd without = materialize(quantized(K, {.exact = 0, .diffusion = false}));
  EXPECT_EQ(without(5, 71), 0);  // lost beside the spike
}

TEST(Quantize, KeepsAtMostTheFractionAsked) {
  const SymmetricTiles<double> K = falling_kernel(150);
  for (const double fraction : {0.0, 0.001, 0.01, 0.1, 1.0}) {
    const auto count = static_cast<double>(quantized(K, {.exact = fraction}).exact_value().size());
    EXPECT_LE(count, fraction * 150 * 151 / 2);
    if (fraction < 0.2) {
      EXPECT_GE(count, fraction * 150 * 151 / 2 - 1);
    }
  }
}

TEST(Quantize, ErrsLessWithMoreBitsAndWithExactEntries) {
  const SymmetricTiles<double> K = falling_kernel(200);
  const Eigen::MatrixXd truth = materialize(K);
  const auto error = [&](const QuantizeOptions& options) {
    return (materialize(quantized(K, options)) - truth).norm() / truth.norm();
  };
  EXPECT_LT(error({.bits = 8, .exact = 0}), 1e-2);
  EXPECT_LT(error({.bits = 8, .exact = 0}), error({.bits = 4, .exact = 0}) / 8);
  EXPECT_LT(error({.bits = 4, .exact = 0}), error({.bits = 2, .exact = 0}) / 2);
  EXPECT_LT(error({.exact = 0.02}), error({.exact = 0}) / 1.5);
  EXPECT_EQ(error({.exact = 1}), (materialize(convert<float>(K)) - truth).norm() / truth.norm());
}

TEST(Quantize, DiffusionKeepsTheEnergyOfNeighbours) {
  // Energies w_i w_j K_ij of 16 x 16 entries keep their sums; rounding alone errs the same way in all of
  // them.
  const Index n = 128;
  RandomStream random(3);
  const Eigen::VectorXd weight = Eigen::VectorXd::NullaryExpr(n, [&] { return random.uniform(0.5, 2); });
  const SymmetricTiles<double> K = tiles_with(n, [&](Index i, Index j) {
    return (j % 32 == 31 || i % 32 == 31 ? 1.0 : 0.22) / (weight[i] * weight[j]);
  });
  const auto worst = [&](bool diffusion) {
    const QuantizedTiles coded = quantize(K, weight, {.bits = 4, .exact = 0, .diffusion = diffusion});
    const Eigen::MatrixXd energy =
        weight.asDiagonal() * (materialize(coded) - materialize(K)) * weight.asDiagonal();
    return std::abs(energy.block(0, 64, 16, 16).sum()) + std::abs(energy.block(32, 96, 16, 16).sum());
  };
  EXPECT_LT(worst(true), worst(false) / 3);
}

TEST(Quantize, DoesNotDependOnThreads) {
  const SymmetricTiles<double> K = falling_kernel(300);
  const Eigen::MatrixXd first = materialize(quantized(K, {}));
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(materialize(quantized(K, {})), first);
  }
}

TEST(Quantize, WorksAtEverySize) {
  for (const Index n : {0, 1, 2, 3, 5, 17, 33, 63, 64, 65, 130}) {
    const SymmetricTiles<double> K = falling_kernel(n);
    const Eigen::MatrixXd truth = materialize(K);
    const Eigen::MatrixXd coded = materialize(quantized(K, {.bits = 8}));
    EXPECT_LE((coded - truth).norm(), 1e-2 * truth.norm()) << n;
  }
}

TEST(Quantize, RefusesWhatItCannotCode) {
  const SymmetricTiles<double> K = falling_kernel(70);
  EXPECT_THROW(quantized(K, {.bits = 3}), UsageError);
  EXPECT_THROW(quantized(K, {.bits = 0}), UsageError);
  EXPECT_THROW(quantized(K, {.block = 24}), UsageError);
  EXPECT_THROW(quantized(K, {.exact = -0.1}), UsageError);
  EXPECT_THROW(quantized(K, {.exact = std::nan("")}), UsageError);
  EXPECT_THROW(quantize(K, Eigen::VectorXd::Ones(69), {}), UsageError);
  EXPECT_THROW(quantize(K, Eigen::VectorXd::Zero(70), {}), UsageError);
  for (const double bad : {-1e-9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    SymmetricTiles<double> wrong = falling_kernel(70);
    wrong.set(3, 68, bad);
    EXPECT_THROW(quantized(wrong, {}), Error);
    EXPECT_THROW(keep_largest(wrong, 0.5), Error);
  }
}

TEST(KeepLargest, IsTheBestChoiceOfItsSize) {
  const SymmetricTiles<double> K = falling_kernel(150);
  const Eigen::MatrixXd truth = materialize(K);
  for (const double fraction : {0.0, 0.01, 0.1, 0.5, 1.0}) {
    const QuantizedTiles kept = keep_largest(K, fraction);
    const auto count = static_cast<Index>(fraction * 150 * 151 / 2);
    EXPECT_LE(static_cast<Index>(kept.exact_value().size()), count);
    const Eigen::MatrixXd full = materialize(kept);
    EXPECT_EQ(full, full.transpose());
    double smallest_kept = std::numeric_limits<double>::infinity(), largest_dropped = 0;
    for (Index i = 0; i < 150; ++i)
      for (Index j = 0; j < 150; ++j) {
        if (full(i, j) > 0) {
          EXPECT_EQ(static_cast<float>(full(i, j)), static_cast<float>(truth(i, j)));
          smallest_kept = std::min(smallest_kept, truth(i, j));
        } else {
          largest_dropped = std::max(largest_dropped, truth(i, j));
        }
      }
    EXPECT_GE(smallest_kept, largest_dropped * (1 - 1e-7)) << fraction;
  }
}

TEST(KeepLargest, BreaksTiesInOrderAndDropsTilesThatStayEmpty) {
  const SymmetricTiles<double> K = tiles_with(200, [](Index, Index) { return 0.25; });
  const QuantizedTiles kept = keep_largest(K, 0.01);
  EXPECT_EQ(kept.exact_value().size(), static_cast<std::size_t>(200 * 201 / 200));
  EXPECT_EQ(kept.directory().tile_count(), 1);
}

}  // namespace
}  // namespace radiosity
