#pragma once

#include "kernels/aligned_memory.hpp"
#include "kernels/block_formats.hpp"
#include "kernels/half.hpp"
#include "kernels/tile_directory.hpp"
#include "kernels/tile_format.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace radiosity {

/// A non-negative n x n matrix in tiles of 64 x 64 entries, each a record that a decoder turns into float32
/// numbers (kernels/tile_format.hpp): whole numbers of a few bits with a step that `block` consecutive
/// entries of a row share, codes on a curve, BC4 blocks, or floats of 16 bits. Any entry may be kept apart in
/// float32 instead. The matrix is scale() times what the tiles hold.
///
/// Of a symmetric matrix only the upper triangle is kept. A tile on its diagonal with steps keeps its upper
/// half only, with half of the diagonal's entries: tile + tile' is the block of the matrix, and a code's
/// error counts twice on the diagonal (which is 0 for planar patches). In the other formats it is whole
/// (whole_diagonal()). Rows and columns beyond n are zero.
class QuantizedTiles {
 public:
  static constexpr Index tile_size = TileDirectory::tile_size;
  static constexpr Index tile_entries = TileDirectory::tile_entries;

  /// What is kept apart of one tile: entry (r, c) has position 64 r + c; positions rise.
  struct ExactEntries {
    std::vector<std::uint16_t> position;
    std::vector<float> value;
  };

  /// Zeros. Throws UsageError for formats that do not exist.
  QuantizedTiles(TileDirectory directory, const TileFormat& format);
  /// With steps. `bits` a code: 0 (all entries are kept apart), 2, 4 or 8; `block`: 16, 32 or 64.
  QuantizedTiles(TileDirectory directory, int bits, int block)
      : QuantizedTiles(std::move(directory), TileFormat{EntryCode::steps, bits, block, {}}) {}

  const TileDirectory& directory() const { return directory_; }
  Index size() const { return directory_.size(); }
  const TileFormat& format() const { return format_; }
  bool whole_diagonal() const { return format_.code != EntryCode::steps; }
  int largest_code() const { return (1 << format_.bits) - 1; }

  double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }

  /// The code of entry (r, c) of a tile, where the format has steps or a curve. This and the next three are
  /// safe from several threads for different tiles.
  void set_code(Index tile, Index r, Index c, unsigned code);
  /// Where the format has steps.
  void set_step(Index tile, Index r, Index block, Half step);
  /// The block of the entries (4 row + 0 ... 3, 4 column + 0 ... 3), where the format is BC4.
  void set_block(Index tile, Index row, Index column, const Bc4Block& block);
  /// >= 0, where the format is half or brain; rounded to nearest.
  void set_number(Index tile, Index r, Index c, float number);
  /// One element a tile.
  void set_exact(const std::vector<ExactEntries>& tiles);

  /// The record of a tile, 64-byte aligned, null if there is none:
  ///   steps   the steps by rows, 64 x (64 / block), then the codes. Word c of group g of 64 words holds
  ///   those
  ///           of the entries (g R + k, c), k = 0 ... R - 1, R = 32 / bits, the first in the lowest bits: a
  ///           vector of words yields one row after the other by shifts;
  ///   curve   bytes by rows; with 4 bits byte c of a row holds the entries c and, in its upper bits, c + 32;
  ///   bc4     blocks by rows, 16 x 16;
  ///   half, brain   numbers by rows.
  const std::byte* record(Index tile) const { return records_.get() + tile * record_bytes_; }
  std::ptrdiff_t record_bytes() const { return record_bytes_; }
  /// The entries kept apart of a tile are those numbered exact_begin(tile) ... exact_begin(tile + 1) - 1.
  std::size_t exact_begin(Index tile) const { return exact_begin_[static_cast<std::size_t>(tile)]; }
  const std::vector<std::uint16_t>& exact_position() const { return exact_position_; }
  const std::vector<float>& exact_value() const { return exact_value_; }

  /// The 64 x 64 numbers of a tile, row-major, without scale(): the plain reference of every decoder.
  void decode(Index tile, float* entries) const;
  /// The same as if no entry were kept apart.
  void decode_record(Index tile, float* entries) const;

  std::size_t step_bytes() const;
  std::size_t code_bytes() const;
  std::size_t exact_bytes() const;
  std::size_t directory_bytes() const;

 private:
  Index steps_in_tile() const;
  float stored_number(Index tile, Index r, Index c) const;
  std::byte* writable_record(Index tile) { return records_.get() + tile * record_bytes_; }

  TileDirectory directory_;
  TileFormat format_;
  double scale_ = 1;
  std::ptrdiff_t record_bytes_ = 0;
  std::unique_ptr<std::byte, AlignedRelease> records_;
  std::vector<std::size_t> exact_begin_;
  std::vector<std::uint16_t> exact_position_;
  std::vector<float> exact_value_;
};

/// The full matrix, n x n: the plain reference, and for small n.
Eigen::MatrixXd materialize(const QuantizedTiles& tiles);

}  // namespace radiosity
