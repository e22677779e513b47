#include "foundation/random.hpp"
#include "gpu/tiles_on_device.hpp"
#include "tests/gpu/device_test.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace radiosity {
namespace {

/// Every format of tiles with all that its records can hold, against the plain decoder of the CPU.
class TilesOnDevices : public DeviceTest {
 protected:
  static constexpr Index size = 150;  // three tiles a row, the last of 22

  static std::vector<TileFormat> formats() {
    std::vector<TileFormat> formats = {{EntryCode::half, 0, 0, {}}, {EntryCode::brain, 0, 0, {}}};
    for (const int bits : {2, 4, 8})
      for (const int block : {16, 32, 64}) formats.push_back({EntryCode::steps, bits, block, {}});
    for (const TileCurve& curve : {TileCurve::linear(), TileCurve::logarithm(12)}) {
      for (const int bits : {4, 8}) formats.push_back({EntryCode::curve, bits, 0, curve});
      formats.push_back({EntryCode::bc4, 0, 0, curve});
    }
    return formats;
  }

  static std::string name(const TileFormat& format) {
    return fmt::format("format {} of {} bits, blocks of {}{}", static_cast<int>(format.code), format.bits,
                       format.block, format.curve.logarithmic ? ", logarithmic" : "");
  }

  /// With a tile missing and, if `exact`, entries kept apart.
  static QuantizedTiles random_tiles(const TileFormat& format, bool symmetric, bool exact) {
    const TileDirectory directory =
        symmetric ? TileDirectory(size, [](Index I, Index J) { return I != 0 || J != 1; })
                  : TileDirectory::full(size);
    QuantizedTiles tiles(directory, format);
    tiles.set_scale(0.25);
    RandomStream random(17);
    std::vector<QuantizedTiles::ExactEntries> kept(static_cast<std::size_t>(directory.tile_count()));
    for (Index I = 0; I < directory.tile_rows(); ++I)
      for (Index tile = directory.row_begin(I); tile < directory.row_begin(I + 1); ++tile) {
        const Index J = directory.tile_column(tile);
        if (tiles.record_bytes() > 0) fill(tiles, tile, I == J, random);
        if (exact) kept[static_cast<std::size_t>(tile)] = {{5, 2000}, {0.75F, 0.5F}};  // (0, 5), (31, 16)
      }
    tiles.set_exact(kept);
    return tiles;
  }

  /// Entries within the matrix, the others zero; of a tile on the diagonal of a symmetric one what is
  /// allowed there: either half, or both alike.
  static void fill(QuantizedTiles& tiles, Index tile, bool diagonal, RandomStream& random) {
    const bool blocks = tiles.format().code == EntryCode::bc4;
    for (Index r = 0; r < 64; r += blocks ? 4 : 1)
      for (Index c = 0; c < 64; c += blocks ? 4 : 1) set_entry(tiles, tile, r, c, diagonal, random);
    if (tiles.format().code == EntryCode::steps)
      for (Index r = 0; r < 64; ++r)
        for (Index b = 0; b < 64 / tiles.format().block; ++b)
          tiles.set_step(tile, r, b, to_half(static_cast<float>(random.uniform())));
  }

  static void set_entry(QuantizedTiles& tiles, Index tile, Index r, Index c, bool diagonal,
                        RandomStream& random) {
    const auto whole_number = [&](int below) {
      return static_cast<unsigned>(static_cast<double>(below) * random.uniform());
    };
    switch (tiles.format().code) {
      case EntryCode::steps:
      case EntryCode::curve:
        return tiles.set_code(tile, r, c, diagonal && c < r ? 0 : whole_number(tiles.largest_code() + 1));
      case EntryCode::bc4: {
        Bc4Block block{static_cast<std::uint8_t>(whole_number(256)),
                       static_cast<std::uint8_t>(whole_number(3) * whole_number(80)),
                       {}};
        for (int texel = 0; texel < 16; ++texel)
          set_bc4_index(block, texel, static_cast<int>(whole_number(8)));
        return tiles.set_block(tile, r / 4, c / 4, block);
      }
      case EntryCode::half:
      case EntryCode::brain:
        return tiles.set_number(tile, r, c, static_cast<float>(random.uniform()));
    }
  }

  /// The largest |M X - Y| in units of 2 (n + 8) u |M| |X|, the bound of D1.
  static double worst(const QuantizedTiles& tiles, const DeviceMatrix& copy, Index columns) {
    RandomStream random(3);
    const Field X = Field::NullaryExpr(size, columns, [&] { return random.uniform() - 0.5; });
    Field Y(size, columns);
    copy.multiply(X, Y);
    const Eigen::MatrixXd M = materialize(tiles);
    const Eigen::ArrayXXd bound = 2 * (size + 8) * 0x1p-24 * (M.cwiseAbs() * X.cwiseAbs()).array();
    return ((M * X - Y).array().abs() / bound).maxCoeff();
  }
};

TEST_F(TilesOnDevices, MultiplyAsTheirPlainDecoderDoesInEveryFormat) {
  for (const TileFormat& format : formats())
    for (const bool symmetric : {false, true}) {
      if (format.code == EntryCode::steps && !symmetric) continue;  // there are none
      SCOPED_TRACE(name(format) + (symmetric ? ", symmetric" : ""));
      const QuantizedTiles tiles = random_tiles(format, symmetric, true);
      const TilesOnDevice copy(device(), std::span(&tiles, 1), RowStrategy::invocation);
      EXPECT_LE(worst(tiles, copy, 1), 1);
    }
}

TEST_F(TilesOnDevices, GiveTheSameWithEitherStrategyAndAnyNumberOfColumns) {
  const QuantizedTiles tiles = random_tiles({EntryCode::steps, 4, 32, {}}, true, true);
  for (const RowStrategy strategy : {RowStrategy::group, RowStrategy::invocation})
    EXPECT_LE(worst(tiles, TilesOnDevice(device(), std::span(&tiles, 1), strategy), 7), 1);
}

TEST_F(TilesOnDevices, AreSplitOverStorageBlocksWhoseProductsAddUp) {
  for (const TileFormat& format :
       {TileFormat{EntryCode::steps, 8, 64, {}}, TileFormat{EntryCode::bc4, 0, 0, TileCurve::linear()}}) {
    const QuantizedTiles tiles = random_tiles(format, true, true);
    for (const Index together : {1, 2, 4}) {
      const TilesOnDevice copy(device_with_blocks_of(together * tiles.record_bytes()), std::span(&tiles, 1),
                               RowStrategy::invocation);
      EXPECT_LE(worst(tiles, copy, 1), 1) << together;
    }
  }
}

TEST_F(TilesOnDevices, WithoutRecordsAreWhatIsKeptApart) {
  const QuantizedTiles tiles = random_tiles({EntryCode::steps, 0, 32, {}}, true, true);
  const TilesOnDevice copy(device(), std::span(&tiles, 1), RowStrategy::group);
  const ByteCount bytes = copy.bytes();
  EXPECT_EQ(bytes.parts.front().second, 0U);
  Field Y(size, 1);
  copy.multiply(Field::Ones(size, 1), Y);
  EXPECT_LE((materialize(tiles).rowwise().sum() - Y).norm(), 1e-6);
}

TEST_F(TilesOnDevices, TakeTheirRecordsAndLittleMore) {
  const QuantizedTiles tiles = random_tiles({EntryCode::curve, 8, 0, TileCurve::linear()}, true, false);
  const TilesOnDevice copy(device(), std::span(&tiles, 1), RowStrategy::group);
  const ByteCount bytes = copy.bytes();
  EXPECT_EQ(bytes.parts.front().second, tiles.code_bytes());
  EXPECT_LT(bytes.total(), tiles.code_bytes() + tiles.code_bytes() / 10);
}

/// One step of one block that is another is seen: the bound is no wider than that.
TEST_F(TilesOnDevices, OfWhichOneStepIsWrongAreFoundOut) {
  for (const int block : {16, 64}) {
    const QuantizedTiles tiles = random_tiles({EntryCode::steps, 4, block, {}}, true, true);
    QuantizedTiles wrong = random_tiles({EntryCode::steps, 4, block, {}}, true, true);
    wrong.set_step(1, 9, 0, to_half(0.0F));
    const TilesOnDevice copy(device(), std::span(&wrong, 1), RowStrategy::group);
    EXPECT_GT(worst(tiles, copy, 1), 1);
  }
}

}  // namespace
}  // namespace radiosity
