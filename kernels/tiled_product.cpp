#include "foundation/parallel.hpp"
#include "kernels/blocked_field.hpp"
#include "kernels/partial_sums.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_sources.hpp"

#include <algorithm>
#include <cstddef>

namespace radiosity {
namespace {

/// Cuts the tile rows into chunks of about equal numbers of tiles; chunk k is the tile rows result[k] ...
/// result[k + 1] - 1. Depends on the matrix only, never on threads: it decides the order of the sums.
std::vector<Index> split_tile_rows(const TileDirectory& K) {
  constexpr Index tiles_worth_a_chunk = 64;  // below, partial sums cost more than a thread gains
  // Sums of 64 chunks were a tenth of the traffic of binary16 entries and three columns at n = 16384.
  const Index most_chunks = std::clamp<Index>(K.size() / 1024, 16, 64);
  const Index chunks = std::clamp<Index>(K.tile_count() / tiles_worth_a_chunk, 1, most_chunks);
  std::vector<Index> begin = {0};
  for (Index I = 1; I < K.tile_rows(); ++I)
    if (K.row_begin(I) * chunks >= K.tile_count() * static_cast<Index>(begin.size())) begin.push_back(I);
  begin.push_back(K.tile_rows());
  return begin;
}

enum class Direction { forward, transposed };  ///< K X or K' X: the same for a symmetric K

template <typename Source>
class TileSweep {
 public:
  using Entry = typename Source::Entry;
  using Number = typename Multiplier<Entry>::Type;

  TileSweep(const TileDirectory& directory, const Source& source, Direction direction,
            const BlockedField<Number>& X, PartialSums& sums)
      : directory_(directory), source_(source), direction_(direction), X_(X), sums_(sums) {}

  void multiply_rows(Index chunk, Index first_row, Index last_row) {
    sums_.start(chunk);
    const AlignedBuffer<Number> lanes(static_cast<std::size_t>(column_groups() * row_lanes_size<Entry>));
    const AlignedBuffer<Entry> panel(static_cast<std::size_t>(Source::panel_entries));
    for (Index I = first_row; I < last_row; ++I)
      for (Index tile = directory_.row_begin(I); tile < directory_.row_begin(I + 1); ++tile)
        multiply_tile(chunk, I, tile, source_.read(tile, X_.columns(), panel.data()), lanes.data());
  }

 private:
  static constexpr Index most_columns = TileProducts<Entry>::most_columns;

  Index column_groups() const { return (X_.columns() + most_columns - 1) / most_columns; }

  /// Whether the tiles number `tile` and `tile` + 1 of tile row I are in one run of the sums along rows.
  bool in_one_run(Index I, Index tile) const {
    return tile >= directory_.row_begin(I) && tile + 1 < directory_.row_begin(I + 1) &&
           directory_.tile_column(tile) / tiles_together == directory_.tile_column(tile + 1) / tiles_together;
  }

  void multiply_tile(Index chunk, Index I, Index tile, const Entry* entries, Number* lanes) {
    const Index J = directory_.tile_column(tile);
    const bool first = !in_one_run(I, tile - 1);
    const bool last = !in_one_run(I, tile);
    for (Index c = 0; c < X_.columns(); c += most_columns) {
      const Index columns = std::min(most_columns, X_.columns() - c);
      TileTask<Entry> task;
      task.entries = entries;
      task.row_lanes = lanes + c / most_columns * row_lanes_size<Entry>;
      task.first = first;
      task.last = last;
      task.x_columns = X_.block(J) + 64 * c;
      task.x_columns_scale = X_.scale(J) + c;
      task.y_rows = sums_.block(chunk, I) + 64 * c;
      task.x_rows = X_.block(I) + 64 * c;
      task.x_rows_scale = X_.scale(I) + c;
      task.y_columns = sums_.block(chunk, J) + 64 * c;
      source_.multiply(tile, sums_of(I == J), columns, c == 0, task);
    }
  }

  TileSums sums_of(bool on_diagonal) const {
    if (!directory_.symmetric()) return direction_ == Direction::forward ? TileSums::rows : TileSums::columns;
    return on_diagonal && source_.whole_diagonal() ? TileSums::rows : TileSums::both;
  }

  const TileDirectory& directory_;
  const Source& source_;
  Direction direction_;
  const BlockedField<Number>& X_;
  PartialSums& sums_;
};

/// The first block of Y that a chunk adds to: its own first one, or any where tiles lie below the diagonal.
std::vector<Index> first_blocks(const TileDirectory& directory, const std::vector<Index>& rows) {
  std::vector<Index> first(rows.begin(), rows.end() - 1);
  if (!directory.symmetric()) std::fill(first.begin(), first.end(), 0);
  return first;
}

template <typename Source>
void multiply_tiles(const TileDirectory& directory, const Source& source, Direction direction, double scale,
                    const ConstFieldRef& X, FieldRef Y) {
  using Entry = typename Source::Entry;
  check_product_shapes(directory.size(), directory.size(), X, Y);
  const std::vector<Index> rows = split_tile_rows(directory);
  const std::vector<Index> first_block = first_blocks(directory, rows);
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Index columns = std::min(columns_at_once, X.cols() - first);
    const BlockedField<typename Multiplier<Entry>::Type> blocked(X, first, columns);
    PartialSums sums(blocked.blocks(), columns, first_block);
    TileSweep<Source> product(directory, source, direction, blocked, sums);
    parallel_for(first_block.size(), [&](std::size_t chunk) {
      product.multiply_rows(static_cast<Index>(chunk), rows[chunk], rows[chunk + 1]);
    });
    sums.finish(scale, first, Y);
  }
}

template <typename Scalar>
void multiply_stored(const SymmetricTiles<Scalar>& K, const ConstFieldRef& X, FieldRef Y,
                     InstructionSet instructions) {
  const StoredTileSource<Scalar> source{K, tile_products<Scalar>(instructions)};
  multiply_tiles(K.directory(), source, Direction::forward, K.scale(), X, Y);
}

}  // namespace

void multiply(const SymmetricTiles<double>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_stored(K, X, Y, instructions);
}
void multiply(const SymmetricTiles<float>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_stored(K, X, Y, instructions);
}
void multiply(const SymmetricTiles<Half>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_stored(K, X, Y, instructions);
}

void multiply(const QuantizedTiles& K, const ConstFieldRef& X, FieldRef Y, InstructionSet instructions) {
  multiply_tiles(K.directory(), QuantizedTileSource(K, instructions), Direction::forward, K.scale(), X, Y);
}

void multiply_transposed(const QuantizedTiles& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_tiles(M.directory(), QuantizedTileSource(M, instructions), Direction::transposed, M.scale(), X, Y);
}

}  // namespace radiosity
