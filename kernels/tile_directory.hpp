#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// Which tiles of 64 x 64 entries of an n x n matrix are kept: those of the upper triangle that are not zero
/// if it is symmetric, else all that are not zero. They are numbered by tile row, within one with rising tile
/// column.
class TileDirectory {
 public:
  static constexpr Index tile_size = 64;
  static constexpr Index tile_entries = tile_size * tile_size;

  /// The tiles (I, J), I <= J < tile_rows, for which `present(I, J)` holds. Throws UsageError for n < 0.
  TileDirectory(Index size, const std::function<bool(Index, Index)>& present);

  /// All tiles of a matrix that is not symmetric.
  static TileDirectory full(Index size);

  Index size() const { return size_; }
  bool symmetric() const { return symmetric_; }
  Index tile_rows() const { return (size_ + tile_size - 1) / tile_size; }
  Index tile_count() const { return static_cast<Index>(columns_.size()); }

  /// The tiles of tile row I are those numbered row_begin(I) ... row_begin(I + 1) - 1.
  Index row_begin(Index tile_row) const { return row_begin_[static_cast<std::size_t>(tile_row)]; }
  Index tile_column(Index tile) const { return columns_[static_cast<std::size_t>(tile)]; }

  /// The tile (I, J), I <= J if symmetric, or -1 if it is not kept.
  Index find_tile(Index tile_row, Index tile_column) const;

  std::size_t bytes() const;

 private:
  TileDirectory(Index size, bool symmetric, const std::function<bool(Index, Index)>& present);

  Index size_;
  bool symmetric_;
  std::vector<Index> row_begin_;
  std::vector<std::int32_t> columns_;
};

}  // namespace radiosity
