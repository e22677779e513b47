#pragma once

#include "kernels/instruction_set.hpp"
#include "kernels/tile_format.hpp"

#include <cstddef>

// The innermost loops of quantized tiles, one translation unit an instruction set. This header is read by
// files that are compiled for wider vectors than the rest of the program and so includes nothing that defines
// inline functions of any weight.

namespace radiosity {

/// Turns the record of a tile (kernels/quantized_tiles.hpp) into its 64 x 64 numbers, row-major and 64-byte
/// aligned, and fetches as many bytes at `prefetch` ahead. All instruction sets give the same bits.
using TileDecoder = void (*)(const std::byte* record, const std::byte* prefetch, const TileCurve& curve,
                             float* entries);

/// Null where there is nothing to decode (steps of 0 bits).
TileDecoder tile_decoder(InstructionSet instructions, const TileFormat& format);

TileDecoder baseline_tile_decoder(const TileFormat& format);
TileDecoder avx2_tile_decoder(const TileFormat& format);
TileDecoder avx512_tile_decoder(const TileFormat& format);

}  // namespace radiosity
