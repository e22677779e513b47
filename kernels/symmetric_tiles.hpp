#pragma once

#include "kernels/half.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// A symmetric n x n matrix whose upper triangle is kept in square tiles; tiles that are zero are not kept at
/// all. So a product reads half of the entries of a full matrix, and nothing where patches face away from
/// each other or live in separate rooms. Rows and columns beyond n (the last tile's padding) are zero.
/// Scalar: double, float or Half; the matrix is scale() times the stored numbers.
template <typename Scalar>
class SymmetricTiles {
 public:
  static constexpr Index tile_size = 64;
  static constexpr Index tile_entries = tile_size * tile_size;

  /// A zero matrix with room for the tiles (I, J), I <= J < tile_rows, for which `present(I, J)` holds.
  SymmetricTiles(Index size, const std::function<bool(Index, Index)>& present);

  Index size() const { return size_; }
  Index tile_rows() const { return (size_ + tile_size - 1) / tile_size; }
  Index tile_count() const { return static_cast<Index>(columns_.size()); }

  double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }

  /// The tiles of tile row I are those numbered row_begin(I) ... row_begin(I + 1) - 1, with rising tile
  /// column.
  Index row_begin(Index tile_row) const { return row_begin_[static_cast<std::size_t>(tile_row)]; }
  Index tile_column(Index tile) const { return columns_[static_cast<std::size_t>(tile)]; }

  /// 64 x 64 entries, row-major, 64-byte aligned: entry (r, c) of tile (I, J) is K(64 I + r, 64 J + c).
  /// A tile on the diagonal keeps both its halves.
  Scalar* tile_data(Index tile) { return entries_.get() + tile * tile_entries; }
  const Scalar* tile_data(Index tile) const { return entries_.get() + tile * tile_entries; }

  /// The tile (I, J), I <= J, or -1 if it is not kept.
  Index find_tile(Index tile_row, Index tile_column) const;

  /// scale() times the stored entry; 0 where no tile is kept. Any order of i and j.
  double operator()(Index i, Index j) const;

  /// Sets (i, j) and (j, i) to a stored value (without scale). Throws std::out_of_range if their tile is not
  /// kept. Safe from several threads for different unordered pairs.
  void set(Index i, Index j, Scalar value);

  /// Bytes of the entries and of the directory of tiles.
  std::size_t entry_bytes() const {
    return static_cast<std::size_t>(tile_count() * tile_entries) * sizeof(Scalar);
  }
  std::size_t directory_bytes() const;

  /// A copy without the tiles whose entries are all zero.
  SymmetricTiles without_zero_tiles() const;

 private:
  struct Release {
    void operator()(Scalar* entries) const;
  };

  Index size_;
  double scale_ = 1;
  std::vector<Index> row_begin_;
  std::vector<std::int32_t> columns_;
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
