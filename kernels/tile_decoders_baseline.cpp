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

  using Bc4Palettes = float[16][8];

  template <bool logarithmic>
  static void get_palettes(const std::uint64_t* blocks, const TileCurve& curve, Bc4Palettes& palettes) {
    for (int b = 0; b < 16; ++b) bc4_palette<logarithmic>(blocks[b], curve, palettes[b]);
  }

  static void store_bc4(const std::uint64_t* blocks, const Bc4Palettes& palettes, float* entries) {
    for (int b = 0; b < 16; ++b)
      for (int texel = 0; texel < 16; ++texel)
        entries[texel / 4 * 64 + 4 * b + texel % 4] = palettes[b][blocks[b] >> (16 + 3 * texel) & 7];
  }

 private:
  /// As bc4_numbers has it.
  template <bool logarithmic>
  static void bc4_palette(std::uint64_t block, const TileCurve& curve, float (&palette)[8]) {
    const auto first = static_cast<float>(block & 255);
    const auto second = static_cast<float>(block >> 8 & 255);
    const bool eight = first > second;
    const float part = eight ? bc4_seventh : bc4_fifth;
    const int last = eight ? 7 : 5;
    palette[6] = 0;
    palette[7] = on_tile_curve<logarithmic>(255, curve);
    palette[0] = on_tile_curve<logarithmic>(first, curve);
    palette[1] = on_tile_curve<logarithmic>(second, curve);
    if constexpr (logarithmic) {
      const std::int32_t mask = first + second > 0 ? -1 : 0;
      const auto A = static_cast<std::int32_t>(first * curve.slope + curve.base);
      const auto B = static_cast<std::int32_t>(second * curve.slope + curve.base);
      const auto step = static_cast<std::int32_t>(static_cast<float>(B - A) * part);
      for (int k = 1; k < last; ++k) {
        const std::int32_t word = (A + k * step) & mask;
        std::memcpy(palette + k + 1, &word, sizeof word);
      }
    } else {
      const float step = (palette[1] - palette[0]) * part;
      for (int k = 1; k < last; ++k) palette[k + 1] = palette[0] + static_cast<float>(k) * step;
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
