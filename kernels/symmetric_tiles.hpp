#pragma once

#include "kernels/half.hpp"
#include "kernels/tile_directory.hpp"

#include <cstddef>
#include <functional>
#include <memory>

namespace radiosity {

/// A symmetric n x n matrix whose upper triangle is kept in square tiles; tiles that are zero are not kept at
/// all. So a product reads half of the entries of a full matrix, and nothing where patches face away from
/// each other or live in separate rooms. Rows and columns beyond n (the last tile's padding) are zero.
/// Scalar: double, float or Half; the matrix is scale() times the stored numbers.
template <typename Scalar>
class SymmetricTiles {
 public:
  static constexpr Index tile_size = TileDirectory::tile_size;
  static constexpr Index tile_entries = TileDirectory::tile_entries;

  /// A zero matrix with room for the tiles (I, J), I <= J < tile_rows, for which `present(I, J)` holds.
  SymmetricTiles(Index size, const std::function<bool(Index, Index)>& present)
      : SymmetricTiles(TileDirectory(size, present)) {}
  explicit SymmetricTiles(TileDirectory directory);

  const TileDirectory& directory() const { return directory_; }
  Index size() const { return directory_.size(); }
  Index tile_rows() const { return directory_.tile_rows(); }
  Index tile_count() const { return directory_.tile_count(); }
  Index row_begin(Index tile_row) const { return directory_.row_begin(tile_row); }
  Index tile_column(Index tile) const { return directory_.tile_column(tile); }
  Index find_tile(Index tile_row, Index tile_column) const {
    return directory_.find_tile(tile_row, tile_column);
  }

  double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }

  /// 64 x 64 entries, row-major, 64-byte aligned: entry (r, c) of tile (I, J) is K(64 I + r, 64 J + c).
  /// A tile on the diagonal keeps both its halves.
  Scalar* tile_data(Index tile) { return entries_.get() + tile * tile_entries; }
  const Scalar* tile_data(Index tile) const { return entries_.get() + tile * tile_entries; }

  /// scale() times the stored entry; 0 where no tile is kept. Any order of i and j.
  double operator()(Index i, Index j) const;

  /// Sets (i, j) and (j, i) to a stored value (without scale). Throws std::out_of_range if their tile is not
  /// kept. Safe from several threads for different unordered pairs.
  void set(Index i, Index j, Scalar value);

  /// Bytes of the entries and of the directory of tiles.
  std::size_t entry_bytes() const {
    return static_cast<std::size_t>(tile_count() * tile_entries) * sizeof(Scalar);
  }
  std::size_t directory_bytes() const { return directory_.bytes(); }

  /// A copy without the tiles whose entries are all zero.
  SymmetricTiles without_zero_tiles() const;

 private:
  struct Release {
    void operator()(Scalar* entries) const;
  };

  TileDirectory directory_;
  double scale_ = 1;
  std::unique_ptr<Scalar[], Release> entries_;
};

/// The same matrix in another precision, each entry rounded once. A narrower type gets a scale that is a
/// power of two: for Half it puts the largest entry near the top of binary16's range, so that entries down to
/// 2e-9 of it keep all their digits; for float near 1. Throws Error for entries that are NaN or infinite.
template <typename To, typename From>
SymmetricTiles<To> convert(const SymmetricTiles<From>& tiles);

/// The full n x n matrix: the plain reference, and for small n.
template <typename Scalar>
Eigen::MatrixXd materialize(const SymmetricTiles<Scalar>& tiles);

extern template class SymmetricTiles<double>;
extern template class SymmetricTiles<float>;
extern template class SymmetricTiles<Half>;

}  // namespace radiosity
