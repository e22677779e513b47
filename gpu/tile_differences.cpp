#include "gpu/tile_differences.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

constexpr Index tile_side = QuantizedTiles::tile_size;

using SparseRows = std::vector<std::vector<std::pair<std::int32_t, double>>>;

/// The differences by rows, without the scale of the tiles.
SparseRows difference_rows(const QuantizedTiles& tiles) {
  const TileDirectory& directory = tiles.directory();
  SparseRows rows(static_cast<std::size_t>(tiles.size()));
  const auto add = [&](Index row, Index column, double difference) {
    if (row < tiles.size() && column < tiles.size())
      rows[static_cast<std::size_t>(row)].emplace_back(static_cast<std::int32_t>(column), difference);
  };
  std::array<float, QuantizedTiles::tile_entries> texels;
  for (Index I = 0; I < directory.tile_rows(); ++I)
    for (Index tile = directory.row_begin(I); tile < directory.row_begin(I + 1); ++tile) {
      const Index J = directory.tile_column(tile);
      if (tiles.exact_begin(tile) == tiles.exact_begin(tile + 1)) continue;
      tiles.decode_record(tile, texels.data());
      for (std::size_t k = tiles.exact_begin(tile); k < tiles.exact_begin(tile + 1); ++k) {
        const std::size_t position = tiles.exact_position()[k];
        const double difference =
            static_cast<double>(tiles.exact_value()[k]) - static_cast<double>(texels[position]);
        const Index row = tile_side * I + static_cast<Index>(position) / tile_side;
        const Index column = tile_side * J + static_cast<Index>(position) % tile_side;
        add(row, column, difference);
        if (directory.symmetric() && (I != J || !tiles.whole_diagonal())) add(column, row, difference);
      }
    }
  return rows;
}

CsrMatrix<float> compressed_rows_of(const SparseRows& rows, double scale) {
  CsrMatrix<float> matrix;
  matrix.cols = static_cast<Index>(rows.size());
  for (const auto& row : rows) {
    for (const auto& [column, difference] : row) {
      matrix.column.push_back(column);
      matrix.value.push_back(static_cast<float>(scale * difference));
    }
    matrix.row_begin.push_back(static_cast<std::int64_t>(matrix.value.size()));
  }
  return matrix;
}

/// Of the entries of a channel's matrix; what tiles hold is a part of their scale.
double largest_entry(const QuantizedTiles& tiles) {
  double largest = 1;
  for (const float value : tiles.exact_value()) largest = std::max(largest, static_cast<double>(value));
  return tiles.scale() * largest;
}

}  // namespace

KeptApart differences_from_texels(std::span<const QuantizedTiles> channels) {
  double largest = 0;
  for (const QuantizedTiles& tiles : channels) largest = std::max(largest, largest_entry(tiles));
  KeptApart result{storage_scale<float>(largest), {}};
  for (const QuantizedTiles& tiles : channels)
    result.channels.push_back(compressed_rows_of(difference_rows(tiles), tiles.scale() / result.scale));
  return result;
}

}  // namespace radiosity
