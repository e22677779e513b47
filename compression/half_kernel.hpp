#pragma once

#include "kernels/quantized_tiles.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <array>
#include <bitset>
#include <cstddef>
#include <vector>

namespace radiosity {

/// The tiles of a non-negative K as QuantizedTiles keeps them: what is below the diagonal is zero, the
/// diagonal halved.
class HalfKernel {
 public:
  static constexpr std::size_t tile_size = QuantizedTiles::tile_size;
  static constexpr std::size_t tile_entries = QuantizedTiles::tile_entries;
  using Tile = std::array<double, tile_entries>;
  using Marks = std::bitset<tile_entries>;

  /// Keeps a reference to K. Throws Error for entries that are negative, infinite or NaN.
  explicit HalfKernel(const SymmetricTiles<double>& K);

  std::size_t tile_count() const { return row_of_tile_.size(); }
  Index tile_row(std::size_t tile) const { return row_of_tile_[tile]; }
  Index tile_column(std::size_t tile) const { return K_.tile_column(static_cast<Index>(tile)); }
  /// Largest entry of K.
  double largest() const { return largest_ * K_.scale(); }
  /// So many entries of the upper triangle are `fraction` of all n^2. Throws UsageError unless 0 <= fraction
  /// <= 1.
  std::size_t share_of_entries(double fraction) const;

  /// The numbers of a tile, row-major, divided by `scale`.
  Tile tile(std::size_t number, double scale) const;

  /// Those of a tile's entries that are marked, in float32.
  static QuantizedTiles::ExactEntries marked_entries(const Tile& tile, const Marks& marks);

 private:
  const SymmetricTiles<double>& K_;
  std::vector<Index> row_of_tile_;
  double largest_ = 0;
};

}  // namespace radiosity
