#include "kernels/tile_decoders.hpp"

namespace radiosity {

TileDecoder tile_decoder(InstructionSet instructions, const TileFormat& format) {
  if (format.record_bytes() == 0) return nullptr;
#if defined(RADIOSITY_X86_KERNELS)
  if (instructions == InstructionSet::avx512) return avx512_tile_decoder(format);
  if (instructions == InstructionSet::avx2) return avx2_tile_decoder(format);
#endif
  static_cast<void>(instructions);
  return baseline_tile_decoder(format);
}

}  // namespace radiosity
