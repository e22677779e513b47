#include "compression/compressed_colours.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <array>

namespace radiosity {
namespace {

bool is_identity(const std::vector<Index>& order) {
  for (std::size_t p = 0; p < order.size(); ++p)
    if (order[p] != static_cast<Index>(p)) return false;
  return true;
}

/// The tiles of a tile row of a full matrix.
void add_tiles(const QuantizedTiles& tiles, Index tile_row, CompressedColours::RowMatrix& rows) {
  constexpr Index side = QuantizedTiles::tile_size;
  std::array<float, QuantizedTiles::tile_entries> entries;
  const TileDirectory& directory = tiles.directory();
  for (Index tile = directory.row_begin(tile_row); tile < directory.row_begin(tile_row + 1); ++tile) {
    tiles.decode(tile, entries.data());
    const Index first = side * directory.tile_column(tile);
    for (Index r = 0; r < rows.rows(); ++r)
      for (Index c = 0; c < std::min(side, rows.cols() - first); ++c)
        rows(r, first + c) =
            tiles.scale() * static_cast<double>(entries[static_cast<std::size_t>(r * side + c)]);
  }
}

}  // namespace

CompressedColours::CompressedColours(std::variant<ColourTexture, Tiles> texels, std::vector<ExactRows> exact,
                                     std::vector<Index> order)
    : texels_(std::move(texels)),
      exact_(std::move(exact)),
      order_(std::move(order)),
      identity_(is_identity(order_)) {}

Index CompressedColours::channels() const {
  const auto* tiles = std::get_if<Tiles>(&texels_);
  return tiles != nullptr ? static_cast<Index>(tiles->size()) : texture()->channels();
}

void CompressedColours::multiply(const ConstFieldRef& X, FieldRef Y) const {
  multiply_in_order(X, Y, false);
}

void CompressedColours::multiply_transposed(const ConstFieldRef& X, FieldRef Y) const {
  multiply_in_order(X, Y, true);
}

void CompressedColours::multiply_in_order(const ConstFieldRef& X, FieldRef Y, bool transposed) const {
  if (X.rows() != size() || Y.rows() != size() || X.cols() != Y.cols() || X.cols() % channels() != 0)
    fail<UsageError>("fields of {} x {} and {} x {} do not fit {} compressed matrices of {} rows", X.rows(),
                     X.cols(), Y.rows(), Y.cols(), channels(), size());
  Eigen::MatrixXd product(size(), X.cols());
  if (identity_) {
    multiply_stored(X, product, transposed);
    Y = product;
  } else {
    multiply_stored(X(order_, Eigen::all), product, transposed);
    Y(order_, Eigen::all) = product;
  }
}

void CompressedColours::multiply_stored(const Eigen::MatrixXd& X, Eigen::MatrixXd& Y, bool transposed) const {
  if (const auto* tiles = std::get_if<Tiles>(&texels_)) {
    for (Index j = 0; j < X.cols(); ++j) {
      const QuantizedTiles& own = (*tiles)[static_cast<std::size_t>(j % channels())];
      if (transposed)
        radiosity::multiply_transposed(own, X.col(j), Y.col(j), instructions_);
      else
        radiosity::multiply(own, X.col(j), Y.col(j), instructions_);
    }
    return;
  }
  if (transposed)
    radiosity::multiply_transposed(*texture(), X, Y, instructions_);
  else
    radiosity::multiply(*texture(), X, Y, instructions_);
  for (Index j = 0; j < X.cols(); ++j) {
    const ExactRows& own = exact_[static_cast<std::size_t>(j % channels())];
    if (transposed)
      own.add_transposed_product(1, X.col(j), Y.col(j));
    else
      own.add_product(1, X.col(j), Y.col(j));
  }
}

std::vector<std::pair<std::string, std::size_t>> CompressedColours::byte_parts() const {
  std::size_t texels = 0, values = 0, indices = 0;
  if (const auto* tiles = std::get_if<Tiles>(&texels_)) {
    for (const QuantizedTiles& own : *tiles) {
      texels += own.code_bytes() + own.step_bytes();
      values += own.exact_value().size() * sizeof(float);
      indices += own.exact_position().size() * sizeof(std::uint16_t) + own.directory_bytes();
    }
  } else {
    texels = texture()->block_bytes();
  }
  for (const ExactRows& own : exact_) {
    values += own.value_bytes();
    indices += own.index_bytes();
  }
  const std::size_t permutation = identity_ ? 0 : order_.size() * sizeof(Index);
  return {{"texels", texels}, {"exact", values}, {"indices", indices}, {"permutation", permutation}};
}

CompressedColours::RowMatrix CompressedColours::decode_rows(Index channel, Index group) const {
  const Index first = group * rows_of_group;
  RowMatrix rows = RowMatrix::Zero(std::min(rows_of_group, size() - first), size());
  if (const auto* tiles = std::get_if<Tiles>(&texels_)) {
    add_tiles((*tiles)[static_cast<std::size_t>(channel)], group, rows);
    return rows;
  }
  for (Index r = 0; r < rows.rows(); ++r) {
    for (Index c = 0; c < size(); ++c) rows(r, c) = (*texture())(first + r, c, static_cast<int>(channel));
    exact_[static_cast<std::size_t>(channel)].add_row(first + r, rows.row(r).data());
  }
  return rows;
}

Eigen::MatrixXd CompressedColours::materialize(Index channel) const {
  Eigen::MatrixXd matrix(size(), size());
  parallel_for(static_cast<std::size_t>(row_groups()), [&](std::size_t group) {
    const RowMatrix rows = decode_rows(channel, static_cast<Index>(group));
    for (Index r = 0; r < rows.rows(); ++r) {
      const Index patch = order_[group * rows_of_group + static_cast<std::size_t>(r)];
      for (Index c = 0; c < size(); ++c) matrix(patch, order_[static_cast<std::size_t>(c)]) = rows(r, c);
    }
  });
  return matrix;
}

}  // namespace radiosity
