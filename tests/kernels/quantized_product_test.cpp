#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/aligned_memory.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_decoders.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Random codes, steps (subnormal ones among them) and entries kept apart, in the tiles for which `kept`
/// holds.
template <typename Kept>
QuantizedTiles random_tiles(Index n, int bits, int block, std::uint64_t seed, const Kept& kept) {
  RandomStream random(seed);
  QuantizedTiles tiles(TileDirectory(n, kept), bits, block);
  tiles.set_scale(0.125);
  std::vector<QuantizedTiles::ExactEntries> exact(static_cast<std::size_t>(tiles.directory().tile_count()));
  for (Index I = 0; I < tiles.directory().tile_rows(); ++I)
    for (Index tile = tiles.directory().row_begin(I); tile < tiles.directory().row_begin(I + 1); ++tile) {
      const Index J = tiles.directory().tile_column(tile);
      for (Index r = 0; r < 64; ++r)
        for (Index c = 0; c < 64; ++c) {
          if (bits > 0 && c % block == 0)
            tiles.set_step(tile, r, c / block, to_half(std::pow(10.0, random.uniform(-8, 2))));
          if (64 * I + r >= n || 64 * J + c >= n || 64 * I + r > 64 * J + c) continue;
          if (bits > 0) tiles.set_code(tile, r, c, static_cast<unsigned>(random.below(1U << bits)));
          if (random.uniform() < 0.02) {
            exact[static_cast<std::size_t>(tile)].position.push_back(static_cast<std::uint16_t>(64 * r + c));
            exact[static_cast<std::size_t>(tile)].value.push_back(static_cast<float>(random.uniform(0, 100)));
          }
        }
    }
  tiles.set_exact(exact);
  return tiles;
}

QuantizedTiles random_tiles(Index n, int bits, int block, std::uint64_t seed) {
  return random_tiles(n, bits, block, seed, [](Index, Index) { return true; });
}

TEST(TileDecoder, GivesTheBitsOfThePlainOneWithEveryInstructionSet) {
  for (const int bits : {2, 4, 8})
    for (const int block : {16, 32, 64}) {
      QuantizedTiles tiles = random_tiles(128, bits, block, 31);
      tiles.set_exact(std::vector<QuantizedTiles::ExactEntries>(3));
      for (const InstructionSet set : available_instruction_sets())
        for (Index tile = 0; tile < tiles.directory().tile_count(); ++tile) {
          std::vector<float> plain(QuantizedTiles::tile_entries);
          tiles.decode(tile, plain.data());
          const AlignedBuffer<float> fast(QuantizedTiles::tile_entries);
          tile_decoder(set, tiles.format())(tiles.record(tile), tiles.record(tile), tiles.format().curve,
                                            fast.data());
          EXPECT_TRUE(std::equal(plain.begin(), plain.end(), fast.data()))
              << name(set) << ", " << bits << " bits, block " << block;
        }
    }
}

TEST(TileDecoder, ReadsEveryCode) {
  QuantizedTiles tiles(TileDirectory(64, [](Index, Index) { return true; }), 8, 64);
  for (Index r = 0; r < 64; ++r) {
    tiles.set_step(0, r, 0, to_half(2.0));
    for (Index c = 0; c < 64; ++c) tiles.set_code(0, r, c, static_cast<unsigned>((64 * r + c) % 256));
  }
  std::vector<float> entries(QuantizedTiles::tile_entries);
  tiles.decode(0, entries.data());
  for (std::size_t k = 0; k < entries.size(); ++k) EXPECT_EQ(entries[k], static_cast<float>(2 * (k % 256)));
  tiles.set_code(0, 3, 7, 9);  // over what was there
  tiles.decode(0, entries.data());
  EXPECT_EQ(entries[3 * 64 + 7], 18);
  EXPECT_EQ(entries[3 * 64 + 6], static_cast<float>(2 * ((3 * 64 + 6) % 256)));
}

TEST(QuantizedProduct, MeetsTheBoundOfFloat) {
  for (const int bits : {0, 2, 4, 8})
    for (const Index n : hard_sizes())
      for (const Index columns : {1, 3, 17}) {
        const QuantizedTiles K = random_tiles(n, bits, 32, 41);
        const Eigen::MatrixXd X = random_matrix(n, columns, 42);
        for (const InstructionSet set : available_instruction_sets()) {
          SCOPED_TRACE(std::string(name(set)) + " bits " + std::to_string(bits) + " n " + std::to_string(n) +
                       " columns " + std::to_string(columns));
          Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(n, columns, std::nan(""));
          multiply(K, X, Y, set);
          EXPECT_TRUE(within_product_bound(materialize(K), X, Y, 0x1p-24));
        }
      }
}

TEST(QuantizedProduct, SkipsTilesThatAreNotKept) {
  const auto banded = [](Index I, Index J) { return J - I == 1 || J - I == 5; };
  const QuantizedTiles K = random_tiles(600, 4, 32, 43, banded);
  const Eigen::MatrixXd X = random_matrix(600, 3, 44);
  Eigen::MatrixXd Y(600, 3);
  multiply(K, X, Y);
  EXPECT_TRUE(within_product_bound(materialize(K), X, Y, 0x1p-24));
}

TEST(QuantizedProduct, DoesNotDependOnThreadsOrColumns) {
  const QuantizedTiles K = random_tiles(1500, 4, 32, 45);
  const Eigen::MatrixXd X = random_matrix(1500, 5, 46);
  for (const InstructionSet set : available_instruction_sets()) {
    Eigen::MatrixXd first(1500, 5);
    multiply(K, X, first, set);
    for (const int threads : {1, 2, 8}) {
      const ThreadLimit limit(threads);
      Eigen::MatrixXd again(1500, 5);
      multiply(K, X, again, set);
      EXPECT_EQ(first, again) << name(set);
      Eigen::MatrixXd alone(1500, 1);
      multiply(K, X.col(4), alone, set);
      EXPECT_EQ(alone.col(0), first.col(4)) << name(set);
    }
  }
}

TEST(QuantizedTiles, RefusesFormatsThatItDoesNotHave) {
  const TileDirectory directory(10, [](Index, Index) { return true; });
  EXPECT_THROW(QuantizedTiles(directory, 3, 32), UsageError);
  EXPECT_THROW(QuantizedTiles(directory, 4, 48), UsageError);
  const QuantizedTiles K(directory, 4, 32);
  Eigen::MatrixXd Y(10, 1);
  EXPECT_THROW(multiply(K, Eigen::MatrixXd::Ones(9, 1), Y), UsageError);
}

}  // namespace
}  // namespace radiosity
