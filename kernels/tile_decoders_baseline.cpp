#include "kernels/block_formats.hpp"
#include "kernels/tile_decoders.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

namespace radiosity {
namespace {

template <bool logarithmic>
float on_tile_curve(float code, const TileCurve& curve);

// Vectors of 16 bytes in the language extension that GCC and Clang share: whatever every processor of the
// target has.
struct Codes {
  static constexpr int width = 4;
  typedef std::int32_t Words __attribute__((vector_size(16)));
  typedef std::uint32_t Unsigned __attribute__((vector_size(16)));
  typedef float Vector __attribute__((vector_size(16)));

  static Words load_words(const std::uint32_t* from) {
    Words words;
    std::memcpy(&words, from, sizeof words);
    return words;
  }
  static void store(float* to, Vector vector) { std::memcpy(to, &vector, sizeof vector); }

  /// to_float without its branch: steps are neither infinite nor NaN, and not negative.
  static void widen(const std::uint16_t* halves, float* steps, int count) {
    for (int k = 0; k < count; ++k) {
      const std::uint32_t bits = static_cast<std::uint32_t>(halves[k]) << 13;
      float scaled;
      std::memcpy(&scaled, &bits, sizeof scaled);
      steps[k] = scaled * 0x1p112F;
    }
  }

  template <int bits>
  static Vector steps(float step) {
    return Vector{} + step;
  }
  template <int bits, int shift>
  static Vector decode(Words words, Vector steps) {
    const auto shifted = reinterpret_cast<Words>(reinterpret_cast<Unsigned>(words) >> shift);
    return __builtin_convertvector(shifted & ((1 << bits) - 1), Vector) * steps;
  }

  /// Four blocks of a row.
  template <bool logarithmic>
  static void decode_bc4(const std::uint64_t* blocks, const TileCurve& curve, float* entries) {
    for (int b = 0; b < 4; ++b) {
      const auto first = static_cast<float>(blocks[b] & 255);
      const auto second = static_cast<float>(blocks[b] >> 8 & 255);
      const Bc4Weights& weights = bc4_weights[first > second ? 0 : 1];
      float palette[8];
      for (int k = 0; k < 8; ++k)
        palette[k] = on_tile_curve<logarithmic>(
            (first * weights.first[k] + second * weights.second[k]) + weights.added[k], curve);
      for (int texel = 0; texel < 16; ++texel)
        entries[texel / 4 * 64 + 4 * b + texel % 4] = palette[blocks[b] >> (16 + 3 * texel) & 7];
    }
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/tile_decoders.inl"

namespace radiosity {

TileDecoder baseline_tile_decoder(const TileFormat& format) {
  return decoder(format);
}

}  // namespace radiosity
