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

/// Which sums a tile adds to.
enum class Sums { both, rows, columns };

template <typename Scalar>
typename TileProducts<Scalar>::Function product_of(const TileProducts<Scalar>& products, Sums sums,
                                                   Index columns) {
  const auto& functions = sums == Sums::both   ? products.both
                          : sums == Sums::rows ? products.to_rows
                                               : products.to_columns;
  return functions[columns - 1];
}

/// The same pieces of X and Y for entries of another kind.
template <typename To, typename From>
TileTask<To> same_fields(const TileTask<From>& task) {
  TileTask<To> other;
  other.x_columns = task.x_columns;
  other.x_columns_scale = task.x_columns_scale;
  other.row_lanes = task.row_lanes;
  other.first = task.first;
  other.last = task.last;
  other.y_rows = task.y_rows;
  other.x_rows = task.x_rows;
  other.x_rows_scale = task.x_rows_scale;
  other.y_columns = task.y_columns;
  return other;
}

/// Where the entries of a tile are: in memory as they are multiplied.
template <typename Scalar>
struct StoredSource {
  using Entry = Scalar;
  static constexpr Index panel_entries = 0;

  const SymmetricTiles<Scalar>& K;
  TileProducts<Scalar> products;

  static bool whole_diagonal() { return true; }  ///< whether a tile on the diagonal keeps both halves
  const Entry* read(Index tile, Index, Entry*) const { return K.tile_data(tile); }
  void multiply(Index, Sums sums, Index columns, bool first_time, TileTask<Entry>& task) const {
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
struct QuantizedSource {
  using Entry = float;
  static constexpr Index panel_entries = QuantizedTiles::tile_entries;

  const QuantizedTiles& K;
  TileDecoder decoder;
  TileProducts<float> products;
  TileProducts<Bc4Block> block_products;
  TileProducts<Half> half_products;

  QuantizedSource(const QuantizedTiles& tiles, InstructionSet instructions)
      : K(tiles),
        decoder(tile_decoder(instructions, K.format())),
        products(tile_products<float>(instructions)) {
    if (K.format().code == EntryCode::bc4) block_products = bc4_products(instructions, K.format().curve);
    if (K.format().code == EntryCode::half) half_products = tile_products<Half>(instructions);
  }

  bool whole_diagonal() const { return K.whole_diagonal(); }

  /// Null: the tile is decoded as it is multiplied, which is done once for three columns.
  const Entry* read(Index tile, Index columns, Entry* panel) const {
    const std::size_t end = K.exact_begin(tile + 1);
    if (in_registers(columns) && K.exact_begin(tile) == end) return nullptr;
    if (decoder == nullptr)
      std::fill(panel, panel + panel_entries, 0.0F);
    else
      decoder(K.record(tile), K.record(tile) + tile_bytes_ahead, K.format().curve, panel);
    const std::uint16_t* position = K.exact_position().data();
    const float* value = K.exact_value().data();
    for (std::size_t k = K.exact_begin(tile); k < end; ++k) panel[position[k]] = value[k];
    return panel;
  }

  void multiply(Index tile, Sums sums, Index columns, bool, TileTask<Entry>& task) const {
    if (task.entries != nullptr)
      product_of(products, sums, columns)(task);
    else if (K.format().code == EntryCode::half)
      multiply_record(half_products, tile, sums, columns, task);
    else
      multiply_record(block_products, tile, sums, columns, task);
  }

 private:
  bool in_registers(Index columns) const {
    return columns <= TileProducts<Entry>::most_columns &&
           (block_products.both[0] != nullptr || half_products.both[0] != nullptr);
  }

  template <typename Stored>
  void multiply_record(const TileProducts<Stored>& functions, Index tile, Sums sums, Index columns,
                       const TileTask<Entry>& task) const {
    auto stored = same_fields<Stored>(task);
    stored.entries = reinterpret_cast<const Stored*>(K.record(tile));
    stored.prefetch = reinterpret_cast<const char*>(K.record(tile) + tile_bytes_ahead);
    stored.curve = &K.format().curve;
    product_of(functions, sums, columns)(stored);
  }
};

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

  Sums sums_of(bool on_diagonal) const {
    if (!directory_.symmetric()) return direction_ == Direction::forward ? Sums::rows : Sums::columns;
    return on_diagonal && source_.whole_diagonal() ? Sums::rows : Sums::both;
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
  const StoredSource<Scalar> source{K, tile_products<Scalar>(instructions)};
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
  multiply_tiles(K.directory(), QuantizedSource(K, instructions), Direction::forward, K.scale(), X, Y);
}

void multiply_transposed(const QuantizedTiles& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_tiles(M.directory(), QuantizedSource(M, instructions), Direction::transposed, M.scale(), X, Y);
}

}  // namespace radiosity
