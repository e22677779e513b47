#include "foundation/parallel.hpp"
#include "kernels/blocked_field.hpp"
#include "kernels/partial_sums.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_decoders.hpp"
#include "kernels/tile_products.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace radiosity {
namespace {

/// How far ahead of the arithmetic tiles and records are fetched into the second cache (the first is full of
/// sums). Processors fetch ahead by themselves as long as they compute little for each line that they read,
/// but not across pages: with one or two columns one line a row is asked for, a page ahead. Three columns
/// keep them so busy that they fall behind: every line is asked for, at a distance at which more made no
/// difference. On Zen 4 either case is up to 1.4 times slower with the other's rule. Beyond the last tile
/// nothing of use is fetched.
constexpr std::ptrdiff_t page_bytes = 4096;
constexpr std::ptrdiff_t tile_bytes_ahead = 65536;

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

/// Where the entries of a tile are: in memory as they are multiplied.
template <typename Scalar>
struct StoredSource {
  using Entry = Scalar;
  static constexpr Index panel_entries = 0;

  const SymmetricTiles<Scalar>& K;

  static bool whole_diagonal() { return true; }  ///< whether a tile on the diagonal keeps both halves
  const Entry* read(Index tile, Entry*) const { return K.tile_data(tile); }
  static void fetch_ahead(TileTask<Entry>& task, Index columns) {
    task.prefetch_every_line = columns >= 3;
    task.prefetch =
        reinterpret_cast<const char*>(task.entries) + (columns >= 3 ? tile_bytes_ahead : page_bytes);
  }
};

/// ... or decoded into a panel that stays in the first cache.
struct QuantizedSource {
  using Entry = float;
  static constexpr Index panel_entries = QuantizedTiles::tile_entries;

  const QuantizedTiles& K;
  TileDecoder decoder;

  bool whole_diagonal() const { return K.whole_diagonal(); }
  const Entry* read(Index tile, Entry* panel) const {
    if (decoder == nullptr)
      std::fill(panel, panel + panel_entries, 0.0F);
    else
      decoder(K.record(tile), K.record(tile) + tile_bytes_ahead, K.format().curve, panel);
    const std::uint16_t* position = K.exact_position().data();
    const float* value = K.exact_value().data();
    const std::size_t end = K.exact_begin(tile + 1);
    for (std::size_t k = K.exact_begin(tile); k < end; ++k) panel[position[k]] = value[k];
    return panel;
  }
  static void fetch_ahead(TileTask<Entry>&, Index) {}
};

enum class Direction { forward, transposed };  ///< K X or K' X: the same for a symmetric K

template <typename Source>
class TileSweep {
 public:
  using Entry = typename Source::Entry;
  using Number = typename Multiplier<Entry>::Type;

  TileSweep(const TileDirectory& directory, const Source& source, Direction direction,
            const BlockedField<Number>& X, PartialSums& sums, const TileProducts<Entry>& products)
      : directory_(directory),
        source_(source),
        direction_(direction),
        X_(X),
        sums_(sums),
        products_(products) {}

  void multiply_rows(Index chunk, Index first_row, Index last_row) {
    sums_.start(chunk);
    const AlignedBuffer<Number> lanes(static_cast<std::size_t>(column_groups() * row_lanes_size<Entry>));
    const AlignedBuffer<Entry> panel(static_cast<std::size_t>(Source::panel_entries));
    for (Index I = first_row; I < last_row; ++I)
      for (Index tile = directory_.row_begin(I); tile < directory_.row_begin(I + 1); ++tile)
        multiply_tile(chunk, I, tile, source_.read(tile, panel.data()), lanes.data());
  }

 private:
  Index column_groups() const {
    return (X_.columns() + TileProducts<Entry>::most_columns - 1) / TileProducts<Entry>::most_columns;
  }

  /// Whether the tiles number `tile` and `tile` + 1 of tile row I are in one run of the sums along rows.
  bool in_one_run(Index I, Index tile) const {
    return tile >= directory_.row_begin(I) && tile + 1 < directory_.row_begin(I + 1) &&
           directory_.tile_column(tile) / tiles_together == directory_.tile_column(tile + 1) / tiles_together;
  }

  void multiply_tile(Index chunk, Index I, Index tile, const Entry* entries, Number* lanes) {
    const Index J = directory_.tile_column(tile);
    const bool first = !in_one_run(I, tile - 1);
    const bool last = !in_one_run(I, tile);
    for (Index c = 0; c < X_.columns(); c += products_.most_columns) {
      const Index columns = std::min<Index>(products_.most_columns, X_.columns() - c);
      TileTask<Entry> task;
      task.entries = entries;
      if (c == 0) Source::fetch_ahead(task, columns);
      task.row_lanes = lanes + c / products_.most_columns * row_lanes_size<Entry>;
      task.first = first;
      task.last = last;
      task.x_columns = X_.block(J) + 64 * c;
      task.x_columns_scale = X_.scale(J) + c;
      task.y_rows = sums_.block(chunk, I) + 64 * c;
      task.x_rows = X_.block(I) + 64 * c;
      task.x_rows_scale = X_.scale(I) + c;
      task.y_columns = sums_.block(chunk, J) + 64 * c;
      functions(I == J)[columns - 1](task);
    }
  }

  const typename TileProducts<Entry>::Function* functions(bool on_diagonal) const {
    if (!directory_.symmetric())
      return direction_ == Direction::forward ? products_.to_rows : products_.to_columns;
    return on_diagonal && source_.whole_diagonal() ? products_.to_rows : products_.both;
  }

  const TileDirectory& directory_;
  const Source& source_;
  Direction direction_;
  const BlockedField<Number>& X_;
  PartialSums& sums_;
  const TileProducts<Entry>& products_;
};

/// The first block of Y that a chunk adds to: its own first one, or any where tiles lie below the diagonal.
std::vector<Index> first_blocks(const TileDirectory& directory, const std::vector<Index>& rows) {
  std::vector<Index> first(rows.begin(), rows.end() - 1);
  if (!directory.symmetric()) std::fill(first.begin(), first.end(), 0);
  return first;
}

template <typename Source>
void multiply_tiles(const TileDirectory& directory, const Source& source, Direction direction, double scale,
                    const ConstFieldRef& X, FieldRef Y, InstructionSet instructions) {
  using Entry = typename Source::Entry;
  check_product_shapes(directory.size(), directory.size(), X, Y);
  const TileProducts<Entry> products = tile_products<Entry>(instructions);
  const std::vector<Index> rows = split_tile_rows(directory);
  const std::vector<Index> first_block = first_blocks(directory, rows);
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Index columns = std::min(columns_at_once, X.cols() - first);
    const BlockedField<typename Multiplier<Entry>::Type> blocked(X, first, columns);
    PartialSums sums(blocked.blocks(), columns, first_block);
    TileSweep<Source> product(directory, source, direction, blocked, sums, products);
    parallel_for(first_block.size(), [&](std::size_t chunk) {
      product.multiply_rows(static_cast<Index>(chunk), rows[chunk], rows[chunk + 1]);
    });
    sums.finish(scale, first, Y);
  }
}

template <typename Scalar>
void multiply_stored(const SymmetricTiles<Scalar>& K, const ConstFieldRef& X, FieldRef Y,
                     InstructionSet instructions) {
  multiply_tiles(K.directory(), StoredSource<Scalar>{K}, Direction::forward, K.scale(), X, Y, instructions);
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
  const QuantizedSource source{K, tile_decoder(instructions, K.format())};
  multiply_tiles(K.directory(), source, Direction::forward, K.scale(), X, Y, instructions);
}

void multiply_transposed(const QuantizedTiles& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  const QuantizedSource source{M, tile_decoder(instructions, M.format())};
  multiply_tiles(M.directory(), source, Direction::transposed, M.scale(), X, Y, instructions);
}

}  // namespace radiosity
