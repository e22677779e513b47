#include "foundation/parallel.hpp"
#include "kernels/blocked_field.hpp"
#include "kernels/partial_sums.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_products.hpp"

#include <algorithm>

namespace radiosity {
namespace {

/// How far ahead of the arithmetic the tiles are fetched: processors do not fetch ahead across pages of 4 KiB
/// by themselves. From 4 to 16 KiB gave the same, 10 to 40 % over none. Beyond the last tile it fetches
/// nothing of use.
constexpr std::ptrdiff_t bytes_ahead = 8192;

/// Cuts the tile rows into chunks of about equal numbers of tiles; chunk k is the tile rows result[k] ...
/// result[k + 1] - 1. Depends on the matrix only, never on threads: it decides the order of the sums.
template <typename Scalar>
std::vector<Index> split_tile_rows(const SymmetricTiles<Scalar>& K) {
  constexpr Index tiles_worth_a_chunk = 64;  // below, partial sums cost more than a thread gains
  constexpr Index most_chunks = 64;
  const Index chunks = std::clamp<Index>(K.tile_count() / tiles_worth_a_chunk, 1, most_chunks);
  std::vector<Index> begin = {0};
  for (Index I = 1; I < K.tile_rows(); ++I)
    if (K.row_begin(I) * chunks >= K.tile_count() * static_cast<Index>(begin.size())) begin.push_back(I);
  begin.push_back(K.tile_rows());
  return begin;
}

template <typename Scalar>
class SymmetricProduct {
 public:
  using Number = typename Multiplier<Scalar>::Type;

  SymmetricProduct(const SymmetricTiles<Scalar>& K, const BlockedField<Number>& X, PartialSums& sums,
                   const TileProducts<Scalar>& products)
      : K_(K), X_(X), sums_(sums), products_(products) {}

  void multiply_rows(Index chunk, Index first_row, Index last_row) {
    sums_.start(chunk);
    const AlignedBuffer<Number> lanes(static_cast<std::size_t>(column_groups() * row_lanes_size<Scalar>));
    for (Index I = first_row; I < last_row; ++I)
      for (Index tile = K_.row_begin(I); tile < K_.row_begin(I + 1); ++tile)
        multiply_tile(chunk, I, tile, lanes.data());
  }

 private:
  Index column_groups() const {
    return (X_.columns() + TileProducts<Scalar>::most_columns - 1) / TileProducts<Scalar>::most_columns;
  }

  /// Whether the tiles number `tile` and `tile` + 1 of tile row I are in one run of the sums along rows.
  bool in_one_run(Index I, Index tile) const {
    return tile >= K_.row_begin(I) && tile + 1 < K_.row_begin(I + 1) &&
           K_.tile_column(tile) / tiles_together == K_.tile_column(tile + 1) / tiles_together;
  }

  void multiply_tile(Index chunk, Index I, Index tile, Number* lanes) {
    const Index J = K_.tile_column(tile);
    const bool first = !in_one_run(I, tile - 1);
    const bool last = !in_one_run(I, tile);
    for (Index c = 0; c < X_.columns(); c += products_.most_columns) {
      const Index columns = std::min<Index>(products_.most_columns, X_.columns() - c);
      TileTask<Scalar> task;
      task.entries = K_.tile_data(tile);
      if (c == 0) task.prefetch = reinterpret_cast<const char*>(task.entries) + bytes_ahead;
      task.row_lanes = lanes + c / products_.most_columns * row_lanes_size<Scalar>;
      task.first = first;
      task.last = last;
      task.x_columns = X_.block(J) + 64 * c;
      task.x_columns_scale = X_.scale(J) + c;
      task.y_rows = sums_.block(chunk, I) + 64 * c;
      task.x_rows = X_.block(I) + 64 * c;
      task.x_rows_scale = X_.scale(I) + c;
      task.y_columns = sums_.block(chunk, J) + 64 * c;
      const auto& products = I == J ? products_.to_rows : products_.both;
      products[static_cast<std::size_t>(columns - 1)](task);
    }
  }

  const SymmetricTiles<Scalar>& K_;
  const BlockedField<Number>& X_;
  PartialSums& sums_;
  const TileProducts<Scalar>& products_;
};

template <typename Scalar>
void multiply_symmetric(const SymmetricTiles<Scalar>& K, const ConstFieldRef& X, FieldRef Y,
                        InstructionSet instructions) {
  check_product_shapes(K.size(), K.size(), X, Y);
  const TileProducts<Scalar> products = tile_products<Scalar>(instructions);
  std::vector<Index> rows = split_tile_rows(K);
  std::vector<Index> first_block(rows.begin(), rows.end() - 1);
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Index columns = std::min(columns_at_once, X.cols() - first);
    const BlockedField<typename Multiplier<Scalar>::Type> blocked(X, first, columns);
    PartialSums sums(blocked.blocks(), columns, first_block);
    SymmetricProduct<Scalar> product(K, blocked, sums, products);
    parallel_for(first_block.size(), [&](std::size_t chunk) {
      product.multiply_rows(static_cast<Index>(chunk), rows[chunk], rows[chunk + 1]);
    });
    sums.finish(K.scale(), first, Y);
  }
}

}  // namespace

void multiply(const SymmetricTiles<double>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_symmetric(K, X, Y, instructions);
}
void multiply(const SymmetricTiles<float>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_symmetric(K, X, Y, instructions);
}
void multiply(const SymmetricTiles<Half>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_symmetric(K, X, Y, instructions);
}

}  // namespace radiosity
