#pragma once

#include "kernels/quantized_tiles.hpp"
#include "kernels/symmetric_tiles.hpp"
#include "kernels/tile_decoders.hpp"
#include "kernels/tile_products.hpp"

#include <cstddef>

// Where the entries of tiles come from, for kernels/tiled_product.cpp.

namespace radiosity {

/// How far ahead of the arithmetic tiles and records are fetched into the second cache (the first is full of
/// sums). Processors fetch ahead by themselves as long as they compute little for each line that they read,
/// but not across pages: with one or two columns one line a row is asked for, a page ahead. Three columns
/// keep them so busy that they fall behind: every line is asked for, at a distance at which more made no
/// difference. On Zen 4 either case is up to 1.4 times slower with the other's rule. Beyond the last tile
/// nothing of use is fetched.
inline constexpr std::ptrdiff_t page_bytes = 4096;
inline constexpr std::ptrdiff_t tile_bytes_ahead = 65536;

/// Which sums a tile adds to.
enum class TileSums { both, rows, columns };

template <typename Scalar>
typename TileProducts<Scalar>::Function product_of(const TileProducts<Scalar>& products, TileSums sums,
                                                   Index columns) {
  const auto& functions = sums == TileSums::both   ? products.both
                          : sums == TileSums::rows ? products.to_rows
                                                   : products.to_columns;
  return functions[columns - 1];
}

/// Where the entries of a tile are: in memory as they are multiplied.
template <typename Scalar>
struct StoredTileSource {
  using Entry = Scalar;
  static constexpr Index panel_entries = 0;

  const SymmetricTiles<Scalar>& K;
  TileProducts<Scalar> products;

  static bool whole_diagonal() { return true; }  ///< whether a tile on the diagonal keeps both halves
  const Entry* read(Index tile, Index, Entry*) const { return K.tile_data(tile); }
  void multiply(Index, TileSums sums, Index columns, bool first_time, TileTask<Entry>& task) const {
    if (first_time) {
      task.prefetch_every_line = columns >= 3;
      task.prefetch =
          reinterpret_cast<const char*>(task.entries) + (columns >= 3 ? tile_bytes_ahead : page_bytes);
    }
    product_of(products, sums, columns)(task);
  }
};

/// ... or decoded, into a panel that stays in the first cache or, where no entry of a tile is kept apart and
/// the product can, in registers.
class QuantizedTileSource {
 public:
  using Entry = float;
  static constexpr Index panel_entries = QuantizedTiles::tile_entries;

  QuantizedTileSource(const QuantizedTiles& tiles, InstructionSet instructions);

  bool whole_diagonal() const { return K_.whole_diagonal(); }
  /// Null: the tile is decoded as it is multiplied, which is done once for three columns.
  const Entry* read(Index tile, Index columns, Entry* panel) const;
  void multiply(Index tile, TileSums sums, Index columns, bool first_time, const TileTask<Entry>& task) const;

 private:
  bool in_registers(Index columns) const;
  template <typename Stored>
  void multiply_record(const TileProducts<Stored>& products, Index tile, TileSums sums, Index columns,
                       const TileTask<Entry>& task) const;

  const QuantizedTiles& K_;
  TileDecoder decoder_;
  TileProducts<float> products_;
  TileProducts<Bc4Block> block_products_;
  TileProducts<Half> half_products_;
};

}  // namespace radiosity
