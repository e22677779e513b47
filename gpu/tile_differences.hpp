#pragma once

#include "gpu/texels_on_device.hpp"
#include "kernels/quantized_tiles.hpp"

#include <span>

namespace radiosity {

/// What the entries that quantized tiles keep apart are more than what the tiles hold in their places, for
/// devices that multiply with both: one matrix a channel, of symmetric tiles both halves. Their scale is
/// above every entry.
KeptApart differences_from_texels(std::span<const QuantizedTiles> channels);

}  // namespace radiosity
