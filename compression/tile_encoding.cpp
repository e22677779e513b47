#include "compression/bc4_codec.hpp"
#include "compression/texel_encoding.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <bitset>

namespace radiosity {
namespace {

Bc4Block transpose(const Bc4Block& block) {
  Bc4Block transposed = block;
  for (int texel = 0; texel < 16; ++texel)
    set_bc4_index(transposed, texel, bc4_index(block, texel % 4 * 4 + texel / 4));
  return transposed;
}

/// The largest number of binary16 with room for sums.
constexpr double half_top = 0x1p15;

double scale_of(const TileFormat& format, double largest) {
  if (largest == 0) return 1;
  return format.code == EntryCode::half ? largest / half_top : largest;
}

class TileEncoder {
  static constexpr Index size = QuantizedTiles::tile_size;
  static constexpr Index side = 4;

 public:
  TileEncoder(const ColourMatrix& matrix, const CodedChannel& channel, const std::vector<Index>& order,
              bool fill, QuantizedTiles& tiles)
      : matrix_(matrix),
        channel_(channel),
        order_(order),
        n_(static_cast<Index>(order.size())),
        fill_(fill),
        tiles_(tiles),
        place_(order.size()) {
    for (std::size_t p = 0; p < order.size(); ++p)
      place_[static_cast<std::size_t>(order[p])] = static_cast<Index>(p);
  }

  QuantizedTiles::ExactEntries encode(Index I, Index tile) const {
    const Index J = tiles_.directory().tile_column(tile);
    const Marks exact = exact_marks(I, J);
    switch (tiles_.format().code) {
      case EntryCode::bc4:
        encode_blocks(I, J, tile, exact);
        break;
      case EntryCode::curve:
        encode_codes(I, J, tile);
        break;
      default:
        encode_numbers(I, J, tile, exact);
    }
    return exact_entries(I, J, exact);
  }

 private:
  using Marks = std::bitset<static_cast<std::size_t>(QuantizedTiles::tile_entries)>;

  Index patch(Index place) const { return order_[static_cast<std::size_t>(place)]; }
  bool inside(Index I, Index J, Index r, Index c) const { return size * I + r < n_ && size * J + c < n_; }
  std::uint8_t code(Index I, Index J, Index r, Index c) const {
    return inside(I, J, r, c) ? channel_.code(patch(size * I + r), patch(size * J + c)) : std::uint8_t{0};
  }
  static std::size_t position(Index r, Index c) { return static_cast<std::size_t>(size * r + c); }

  Marks exact_marks(Index I, Index J) const {
    Marks marks;
    for (Index r = 0; r < size && size * I + r < n_; ++r) {
      const auto row = static_cast<std::size_t>(patch(size * I + r));
      for (auto k = channel_.exact.row_begin[row]; k < channel_.exact.row_begin[row + 1]; ++k) {
        const Index c =
            place_[static_cast<std::size_t>(channel_.exact.column[static_cast<std::size_t>(k)])] - size * J;
        if (c >= 0 && c < size) marks.set(position(r, c));
      }
    }
    return marks;
  }

  QuantizedTiles::ExactEntries exact_entries(Index I, Index J, const Marks& marks) const {
    QuantizedTiles::ExactEntries entries;
    for (std::size_t k = 0; k < marks.size(); ++k) {
      if (!marks[k]) continue;
      const auto r = static_cast<Index>(k) / size, c = static_cast<Index>(k) % size;
      entries.position.push_back(static_cast<std::uint16_t>(k));
      entries.value.push_back(static_cast<float>(
          static_cast<double>(matrix_(patch(size * I + r), patch(size * J + c))) / tiles_.scale()));
    }
    return entries;
  }

  void encode_codes(Index I, Index J, Index tile) const {
    const int step = tiles_.format().bits == 4 ? 17 : 1;
    for (Index r = 0; r < size; ++r)
      for (Index c = 0; c < size; ++c)
        tiles_.set_code(tile, r, c, static_cast<unsigned>((code(I, J, r, c) + step / 2) / step));
  }

  void encode_numbers(Index I, Index J, Index tile, const Marks& exact) const {
    for (Index r = 0; r < size; ++r)
      for (Index c = 0; c < size; ++c) {
        if (!inside(I, J, r, c) || exact[position(r, c)]) continue;
        const auto number = static_cast<double>(matrix_(patch(size * I + r), patch(size * J + c)));
        tiles_.set_number(tile, r, c, static_cast<float>(number / tiles_.scale()));
      }
  }

  /// A tile on the diagonal of a symmetric matrix is made symmetric: what is below is the transpose.
  void encode_blocks(Index I, Index J, Index tile, const Marks& exact) const {
    const bool mirrored = tiles_.directory().symmetric() && I == J;
    for (Index R = 0; R < size / side; ++R)
      for (Index C = mirrored ? R : 0; C < size / side; ++C) {
        const Bc4Block block = encode_bc4(texels(I, J, R, C, exact));
        tiles_.set_block(tile, R, C, block);
        if (mirrored && R != C) tiles_.set_block(tile, C, R, transpose(block));
      }
  }

  Bc4Texels texels(Index I, Index J, Index R, Index C, const Marks& exact) const {
    Bc4Texels block;
    for (Index r = 0; r < side; ++r)
      for (Index c = 0; c < side; ++c) {
        const Index row = side * R + r, column = side * C + c, t = side * r + c;
        const bool free = !inside(I, J, row, column) || (fill_ && exact[position(row, column)]);
        block.weight[t] = free ? 0.0F : 1.0F;
        block.code[t] = code(I, J, row, column);
      }
    return block;
  }

  const ColourMatrix& matrix_;
  const CodedChannel& channel_;
  const std::vector<Index>& order_;
  Index n_;
  bool fill_;
  QuantizedTiles& tiles_;
  std::vector<Index> place_;
};

}  // namespace

QuantizedTiles encode_tiles(const ColourMatrix& matrix, const CodedChannel& channel, const TileFormat& format,
                            const std::vector<Index>& order, bool symmetric, bool fill) {
  const auto n = static_cast<Index>(order.size());
  QuantizedTiles tiles(
      symmetric ? TileDirectory(n, [](Index, Index) { return true; }) : TileDirectory::full(n), format);
  tiles.set_scale(scale_of(format, channel.largest));
  const TileEncoder encoder(matrix, channel, order, fill, tiles);
  std::vector<QuantizedTiles::ExactEntries> exact(static_cast<std::size_t>(tiles.directory().tile_count()));
  parallel_for(static_cast<std::size_t>(tiles.directory().tile_rows()), [&](std::size_t row) {
    const auto I = static_cast<Index>(row);
    for (Index tile = tiles.directory().row_begin(I); tile < tiles.directory().row_begin(I + 1); ++tile)
      exact[static_cast<std::size_t>(tile)] = encoder.encode(I, tile);
  });
  tiles.set_exact(exact);
  return tiles;
}

}  // namespace radiosity
