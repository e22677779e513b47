#include "kernels/tile_decoders.hpp"

namespace radiosity {

TileDecoder tile_decoder(InstructionSet instructions, int bits, int block) {
#if defined(RADIOSITY_X86_KERNELS)
  if (instructions == InstructionSet::avx512) return avx512_tile_decoder(bits, block);
  if (instructions == InstructionSet::avx2) return avx2_tile_decoder(bits, block);
#endif
  static_cast<void>(instructions);
  return baseline_tile_decoder(bits, block);
}

}  // namespace radiosity
