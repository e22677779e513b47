#pragma once

#include "compression/colour_compression.hpp"

#include <span>
#include <vector>

namespace radiosity {

// What turns codes into texels, in the order of places: texel (p, q) is entry (order[p], order[q]).

/// A texture of all channels, and what is to be added to it in each: the entries kept apart, less what their
/// own texels hold if these are filled.
struct TextureParts {
  ColourTexture texture;
  std::vector<ExactRows> exact;
};
TextureParts encode_texture(std::span<const CodedChannel> channels, const TextureCurve& curve,
                            const std::vector<Index>& order, Bc1Fit fit, bool fill);

/// Tiles of one channel; of a symmetric matrix the upper triangle. Numbers, not codes, are stored where the
/// format has floats. Without `fill`, texels of exact entries are 0; no matter to the matrix, since the exact
/// ones stand in their place.
QuantizedTiles encode_tiles(const ColourMatrix& matrix, const CodedChannel& channel, const TileFormat& format,
                            const std::vector<Index>& order, bool symmetric, bool fill);

}  // namespace radiosity
