#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/aligned_memory.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_decoders.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiosity {
namespace {

const std::vector<TileFormat>& formats() {
  static const std::vector<TileFormat> all = {
      {EntryCode::curve, 8, 32, TileCurve::logarithm(25)},
      {EntryCode::curve, 8, 32, TileCurve::linear()},
      {EntryCode::curve, 4, 32, TileCurve::logarithm(6)},
      {EntryCode::curve, 4, 32, TileCurve::linear()},
      {EntryCode::bc4, 0, 32, TileCurve::logarithm(6)},
      {EntryCode::bc4, 0, 32, TileCurve::linear()},
      {EntryCode::half, 0, 32, {}},
      {EntryCode::brain, 0, 32, {}},
  };
  return all;
}

Bc4Block random_bc4_block(RandomStream& random) {
  Bc4Block block;
  block.first = static_cast<std::uint8_t>(random.below(256));
  block.second = static_cast<std::uint8_t>(random.below(3) == 0 ? 0 : random.below(256));
  for (std::uint8_t& byte : block.indices) byte = static_cast<std::uint8_t>(random.below(256));
  return block;
}

/// A tile on the diagonal of a symmetric matrix would have to be symmetric: it stays empty here.
bool inside(const TileDirectory& directory, Index i, Index j) {
  return i < directory.size() && j < directory.size() && (i / 64 != j / 64 || !directory.symmetric());
}

/// Random codes in all tiles and 2 % of the entries kept apart; where a format cannot leave entries out, what
/// lies beyond n or below the diagonal is kept apart as 0.
QuantizedTiles coded_tiles(TileDirectory of, const TileFormat& format, std::uint64_t seed) {
  RandomStream random(seed);
  QuantizedTiles tiles(std::move(of), format);
  tiles.set_scale(0.125);
  const TileDirectory& directory = tiles.directory();
  std::vector<QuantizedTiles::ExactEntries> exact(static_cast<std::size_t>(directory.tile_count()));
  for (Index I = 0; I < directory.tile_rows(); ++I)
    for (Index tile = directory.row_begin(I); tile < directory.row_begin(I + 1); ++tile) {
      auto& apart = exact[static_cast<std::size_t>(tile)];
      for (Index r = 0; r < 64; ++r)
        for (Index c = 0; c < 64; ++c) {
          const bool kept = inside(directory, 64 * I + r, 64 * directory.tile_column(tile) + c);
          if (format.code == EntryCode::curve && kept)
            tiles.set_code(tile, r, c, static_cast<unsigned>(random.below(1U << format.bits)));
          if (format.code == EntryCode::bc4 && r % 4 == 0 && c % 4 == 0)
            tiles.set_block(tile, r / 4, c / 4, random_bc4_block(random));
          if ((format.code == EntryCode::half || format.code == EntryCode::brain) && kept)
            tiles.set_number(tile, r, c, static_cast<float>(std::pow(10.0, random.uniform(-7, 2))));
          const bool chosen = kept && random.uniform() < 0.02;
          if (!chosen && (kept || format.code != EntryCode::bc4)) continue;
          apart.position.push_back(static_cast<std::uint16_t>(64 * r + c));
          apart.value.push_back(chosen ? static_cast<float>(random.uniform(0, 2)) : 0.0F);
        }
    }
  tiles.set_exact(exact);
  return tiles;
}

TileDirectory upper(Index n) {
  return {n, [](Index, Index) { return true; }};
}

TEST(TileFormat, DecodesTheBitsOfThePlainOneWithEveryInstructionSet) {
  for (const TileFormat& format : formats()) {
    QuantizedTiles tiles = coded_tiles(TileDirectory::full(128), format, 71);
    tiles.set_exact(std::vector<QuantizedTiles::ExactEntries>(4));
    for (const InstructionSet set : available_instruction_sets())
      for (Index tile = 0; tile < tiles.directory().tile_count(); ++tile) {
        std::vector<float> plain(QuantizedTiles::tile_entries);
        tiles.decode(tile, plain.data());
        const AlignedBuffer<float> fast(QuantizedTiles::tile_entries);
        tile_decoder(set, format)(tiles.record(tile), tiles.record(tile), format.curve, fast.data());
        EXPECT_TRUE(std::equal(plain.begin(), plain.end(), fast.data()))
            << name(set) << ", format " << static_cast<int>(format.code) << ", " << format.bits << " bits";
      }
  }
}

TEST(TileFormat, ProductsMeetTheBoundOfFloat) {
  for (const TileFormat& format : formats())
    for (const bool symmetric : {true, false})
      for (const Index n : {1, 17, 64, 65, 200}) {
        const QuantizedTiles M = coded_tiles(symmetric ? upper(n) : TileDirectory::full(n), format, 72);
        const Eigen::MatrixXd X = random_matrix(n, 4, 73);
        const Eigen::MatrixXd matrix = materialize(M);
        for (const InstructionSet set : available_instruction_sets()) {
          SCOPED_TRACE(std::string(name(set)) + " format " + std::to_string(static_cast<int>(format.code)) +
                       " n " + std::to_string(n) + (symmetric ? " symmetric" : " full"));
          Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(n, 4, std::nan(""));
          multiply(M, X, Y, set);
          EXPECT_TRUE(within_product_bound(matrix, X, Y, 0x1p-24));
          Y.setConstant(std::nan(""));
          multiply_transposed(M, X, Y, set);
          EXPECT_TRUE(within_product_bound(matrix.transpose(), X, Y, 0x1p-24));
        }
      }
}

/// Keeps entries apart that are what they would be anyway, which takes each tile the way over decoded
/// entries.
void keep_first_entries_apart(QuantizedTiles& tiles) {
  std::vector<QuantizedTiles::ExactEntries> exact;
  for (Index tile = 0; tile < tiles.directory().tile_count(); ++tile) {
    std::vector<float> entries(QuantizedTiles::tile_entries);
    tiles.decode(tile, entries.data());
    exact.push_back({{0}, {entries[0]}});
  }
  tiles.set_exact(exact);
}

TEST(TileFormat, GivesTheSameBitsDecodedInRegistersAndInMemory) {
  for (const TileFormat& format : formats())
    for (const bool symmetric : {true, false}) {
      if (format.code != EntryCode::bc4 && format.code != EntryCode::half) continue;
      constexpr Index n = 320;
      QuantizedTiles tiles = coded_tiles(symmetric ? upper(n) : TileDirectory::full(n), format, 76);
      QuantizedTiles apart = coded_tiles(symmetric ? upper(n) : TileDirectory::full(n), format, 76);
      tiles.set_exact(std::vector<QuantizedTiles::ExactEntries>(
          static_cast<std::size_t>(tiles.directory().tile_count())));
      apart.set_exact(std::vector<QuantizedTiles::ExactEntries>(
          static_cast<std::size_t>(apart.directory().tile_count())));
      keep_first_entries_apart(apart);
      for (const Index columns : {1, 2, 3, 4})
        for (const InstructionSet set : available_instruction_sets()) {
          const Eigen::MatrixXd X = random_matrix(n, columns, 77);
          Eigen::MatrixXd first(n, columns);
          Eigen::MatrixXd second(n, columns);
          multiply(tiles, X, first, set);
          multiply(apart, X, second, set);
          EXPECT_EQ(first, second) << name(set) << ", " << columns << " columns";
          multiply_transposed(tiles, X, first, set);
          multiply_transposed(apart, X, second, set);
          EXPECT_EQ(first, second) << name(set) << ", " << columns << " columns, transposed";
          // The random tiles on the diagonal of a symmetric matrix are not symmetric.
          if (symmetric) continue;
          EXPECT_TRUE(within_product_bound(materialize(tiles).transpose(), X, first, 0x1p-24));
        }
    }
}

TEST(TileFormat, FullProductsDoNotDependOnThreads) {
  const QuantizedTiles M = coded_tiles(TileDirectory::full(1200), formats()[4], 74);
  const Eigen::MatrixXd X = random_matrix(1200, 3, 75);
  Eigen::MatrixXd first(1200, 3), first_transposed(1200, 3);
  multiply(M, X, first);
  multiply_transposed(M, X, first_transposed);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::MatrixXd again(1200, 3);
    multiply(M, X, again);
    EXPECT_EQ(first, again);
    multiply_transposed(M, X, again);
    EXPECT_EQ(first_transposed, again);
  }
}

TEST(TileCurve, StandsForPartsBetweenItsEnds) {
  for (const double range : {1.0, 6.0, 25.0, 80.0}) {
    const TileCurve curve = TileCurve::logarithm(range);
    EXPECT_EQ(curve.number(0), 0);
    EXPECT_NEAR(curve.number(255), 1, 1e-4);
    EXPECT_NEAR(std::log(static_cast<double>(curve.number(1e-3F))), -range, 0.07);
    for (int half = 2; half <= 510; ++half) {
      const float code = 0.5F * static_cast<float>(half);
      EXPECT_LT(curve.number(code - 0.5F), curve.number(code));
      EXPECT_NEAR(std::log(static_cast<double>(curve.number(code))),
                  range * (static_cast<double>(code) / 255 - 1), 0.07);
    }
  }
  EXPECT_EQ(TileCurve::linear().number(255), 1);
}

TEST(TileCurve, FindsTheCodeOfAPart) {
  for (const TileCurve& curve : {TileCurve::logarithm(6), TileCurve::logarithm(25), TileCurve::linear()})
    for (int code = 0; code <= 255; ++code)
      EXPECT_NEAR(curve.code(static_cast<double>(curve.number(static_cast<float>(code)))), code, 0.01);
  EXPECT_EQ(TileCurve::logarithm(6).code(0), 0);
  EXPECT_EQ(TileCurve::logarithm(6).code(1e-9), 0);
  EXPECT_EQ(TileCurve::logarithm(6).code(2), 255);
}

TEST(TileFormat, RefusesWhatDoesNotExist) {
  EXPECT_THROW((TileFormat{EntryCode::curve, 3, 32, {}}.record_bytes()), UsageError);
  EXPECT_THROW((TileFormat{EntryCode::steps, 4, 48, {}}.record_bytes()), UsageError);
  EXPECT_THROW(TileCurve::logarithm(0), UsageError);
  EXPECT_THROW(TileCurve::logarithm(81), UsageError);
}

TEST(BlockFormats, IndicesAndPalettesFollowTheFormat) {
  Bc4Block block{200, 100, {}};
  for (int texel = 0; texel < 16; ++texel) set_bc4_index(block, texel, (texel * 5 + 3) % 8);
  for (int texel = 0; texel < 16; ++texel) EXPECT_EQ(bc4_index(block, texel), (texel * 5 + 3) % 8);
  EXPECT_NEAR(bc4_palette(block)[2], (6 * 200 + 100) / 7.0, 1e-12);
  EXPECT_NEAR(bc4_palette({100, 200, {}})[2], (4 * 100 + 200) / 5.0, 1e-12);
  EXPECT_EQ(bc4_palette({100, 200, {}})[6], 0);
  EXPECT_EQ(bc4_palette({100, 200, {}})[7], 255);
  const Bc1Palette palette = bc1_palette({0xf800, 0x001f, 0});
  EXPECT_NEAR(palette[2][0], 2 * 255 / 3.0, 1e-12);
  EXPECT_NEAR(palette[2][2], 255 / 3.0, 1e-12);
  EXPECT_EQ(bc1_palette({0x001f, 0xf800, 0})[3], (std::array<double, 3>{}));
}

}  // namespace
}  // namespace radiosity
