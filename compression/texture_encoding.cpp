#include "compression/texel_encoding.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <numeric>

namespace radiosity {
namespace {

constexpr Index texture_side = ColourTexture::block_side;

/// How many channels keep each entry of four rows apart.
class ExactCounts {
 public:
  ExactCounts(std::span<const CodedChannel> channels, const std::vector<Index>& order, Index block_row)
      : channels_(channels.size()) {
    const auto n = static_cast<Index>(order.size());
    counts_.assign(static_cast<std::size_t>(texture_side * n), 0);
    for (Index r = 0; r < std::min(texture_side, n - texture_side * block_row); ++r)
      for (const CodedChannel& channel : channels) {
        const auto row =
            static_cast<std::size_t>(order[static_cast<std::size_t>(texture_side * block_row + r)]);
        for (auto k = channel.exact.row_begin[row]; k < channel.exact.row_begin[row + 1]; ++k)
          ++counts_[static_cast<std::size_t>(r * n + channel.exact.column[static_cast<std::size_t>(k)])];
      }
    size_ = n;
  }
  /// Whether all of them do: then the texel may be anything.
  bool all(Index r, Index column) const {
    return counts_[static_cast<std::size_t>(r * size_ + column)] == channels_;
  }

 private:
  std::size_t channels_;
  Index size_ = 0;
  std::vector<std::uint8_t> counts_;
};

class TextureEncoder {
 public:
  TextureEncoder(std::span<const CodedChannel> channels, const std::vector<Index>& order, Bc1Fit fit,
                 bool fill)
      : channels_(channels), order_(order), size_(static_cast<Index>(order.size())), fit_(fit), fill_(fill) {}

  void encode_row(Index row, ColourTexture& texture) const {
    const ExactCounts exact(channels_, order_, row);
    for (Index column = 0; texture_side * column < size_; ++column)
      texture.set_block(row, column, encode_bc1(texels(row, column, exact), fit_));
  }

 private:
  Bc1Texels texels(Index row, Index column, const ExactCounts& exact) const {
    Bc1Texels block;
    for (Index r = 0; r < texture_side; ++r)
      for (Index c = 0; c < texture_side; ++c) {
        const Index t = texture_side * r + c, p = texture_side * row + r, q = texture_side * column + c;
        if (p >= size_ || q >= size_) {
          block.weight[t] = 0;
          continue;
        }
        const Index i = order_[static_cast<std::size_t>(p)], j = order_[static_cast<std::size_t>(q)];
        if (fill_ && exact.all(r, j)) block.weight[t] = 0;
        for (std::size_t channel = 0; channel < channels_.size(); ++channel)
          block.code[channels_.size() == 1 ? 1 : channel][t] = channels_[channel].code(i, j);
      }
    return block;
  }

  std::span<const CodedChannel> channels_;
  const std::vector<Index>& order_;
  Index size_;
  Bc1Fit fit_;
  bool fill_;
};

/// The exact entries of a channel at their places, less what the texture has there if it is filled.
ExactRows placed_exact(const CodedChannel& channel, int number, const ColourTexture& texture,
                       const std::vector<Index>& order, bool fill) {
  std::vector<Index> place(order.size());
  for (std::size_t p = 0; p < order.size(); ++p)
    place[static_cast<std::size_t>(order[p])] = static_cast<Index>(p);
  std::vector<ExactRows::Row> rows(order.size());
  parallel_for(rows.size(), [&](std::size_t p) {
    const auto source = static_cast<std::size_t>(order[p]);
    std::vector<std::pair<Index, float>> entries;
    for (auto k = channel.exact.row_begin[source]; k < channel.exact.row_begin[source + 1]; ++k)
      entries.emplace_back(place[static_cast<std::size_t>(channel.exact.column[static_cast<std::size_t>(k)])],
                           channel.exact.value[static_cast<std::size_t>(k)]);
    std::sort(entries.begin(), entries.end());
    for (const auto& [q, value] : entries) {
      const double texel = fill ? texture(static_cast<Index>(p), q, number) : 0;
      rows[p].column.push_back(static_cast<std::int32_t>(q));
      rows[p].value.push_back(static_cast<float>(static_cast<double>(value) - texel));
    }
  });
  return {static_cast<Index>(order.size()), rows};
}

}  // namespace

TextureParts encode_texture(std::span<const CodedChannel> channels, const TextureCurve& curve,
                            const std::vector<Index>& order, Bc1Fit fit, bool fill) {
  const auto n = static_cast<Index>(order.size());
  TextureParts parts{ColourTexture(n, n, static_cast<int>(channels.size()), curve), {}};
  for (std::size_t c = 0; c < channels.size(); ++c)
    parts.texture.set_scale(static_cast<int>(c), channels[c].largest);
  const TextureEncoder encoder(channels, order, fit, fill);
  parallel_for(static_cast<std::size_t>(parts.texture.block_rows()),
               [&](std::size_t row) { encoder.encode_row(static_cast<Index>(row), parts.texture); });
  for (std::size_t c = 0; c < channels.size(); ++c)
    parts.exact.push_back(placed_exact(channels[c], static_cast<int>(c), parts.texture, order, fill));
  return parts;
}

}  // namespace radiosity
