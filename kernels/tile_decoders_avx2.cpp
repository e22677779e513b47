#if defined(__AVX2__)
#include "kernels/block_formats.hpp"
#include "kernels/tile_decoders.hpp"

#include <cstdint>
#include <cstring>
#include <immintrin.h>
#include <utility>

namespace radiosity {
namespace {

struct Codes {
  static constexpr int width = 8;
  using Words = __m256i;
  using Vector = __m256;

  static Words load_words(const std::uint32_t* from) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
  }
  static void store(float* to, Vector vector) { _mm256_store_ps(to, vector); }
  static void widen(const std::uint16_t* halves, float* steps, int count) {
    for (int k = 0; k < count; k += 8)
      store(steps + k, _mm256_cvtph_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(halves + k))));
  }

  template <int bits>
  static Vector steps(float step) {
    return _mm256_set1_ps(step);
  }
  template <int bits, int shift>
  static Vector decode(Words words, Vector steps) {
    const Words codes = _mm256_and_si256(_mm256_srli_epi32(words, shift), _mm256_set1_epi32((1 << bits) - 1));
    return _mm256_mul_ps(_mm256_cvtepi32_ps(codes), steps);
  }

  using Bc4Palettes = Vector[16];

  template <bool logarithmic>
  static void get_palettes(const std::uint64_t* blocks, const TileCurve& curve, Bc4Palettes& palettes) {
    for (int b = 0; b < 16; ++b) palettes[b] = bc4_palette<logarithmic>(blocks[b], curve);
  }

  /// A palette fills a register, where two rows of texels look theirs up.
  static void store_bc4(const std::uint64_t* blocks, const Bc4Palettes& palettes, float* entries) {
    const Words shifts = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
    for (int b = 0; b < 16; ++b)
      for (int half = 0; half < 2; ++half) {
        const Words bits = _mm256_set1_epi32(static_cast<int>(blocks[b] >> (16 + 24 * half)));
        const Vector texels = _mm256_permutevar8x32_ps(palettes[b], _mm256_srlv_epi32(bits, shifts));
        float* rows = entries + 128 * half + 4 * b;
        _mm_store_ps(rows, _mm256_castps256_ps128(texels));
        _mm_store_ps(rows + 64, _mm256_extractf128_ps(texels, 1));
      }
  }

 private:
  /// As bc4_numbers has it.
  template <bool logarithmic>
  static Vector bc4_palette(std::uint64_t block, const TileCurve& curve) {
    const auto first = static_cast<float>(block & 255);
    const auto second = static_cast<float>(block >> 8 & 255);
    const int six = first > second ? 0 : 1;
    const float part = six == 0 ? bc4_seventh : bc4_fifth;
    const Words parts =
        six == 0 ? _mm256_setr_epi32(0, 0, 1, 2, 3, 4, 5, 6) : _mm256_setr_epi32(0, 0, 1, 2, 3, 4, 0, 0);
    const float A = first * curve.slope;
    const float B = second * curve.slope;
    const float top = 255 * curve.slope;
    if constexpr (!logarithmic) {
      const Vector steps = _mm256_mul_ps(_mm256_cvtepi32_ps(parts), _mm256_set1_ps((B - A) * part));
      const Vector palette = _mm256_blend_ps(_mm256_add_ps(_mm256_set1_ps(A), steps), _mm256_set1_ps(B), 2);
      return six == 0 ? palette : _mm256_blend_ps(palette, _mm256_setr_ps(0, 0, 0, 0, 0, 0, 0, top), 0xc0);
    } else {
      const auto a = static_cast<int>(A + curve.base);
      const auto b = static_cast<int>(B + curve.base);
      const auto step = static_cast<int>(static_cast<float>(b - a) * part);
      const Words steps = _mm256_mullo_epi32(parts, _mm256_set1_epi32(step));
      Words palette =
          _mm256_blend_epi32(_mm256_add_epi32(_mm256_set1_epi32(a), steps), _mm256_set1_epi32(b), 2);
      if (six == 1)
        palette = _mm256_blend_epi32(
            palette, _mm256_setr_epi32(0, 0, 0, 0, 0, 0, 0, static_cast<int>(top + curve.base)), 0xc0);
      return _mm256_castsi256_ps(_mm256_and_si256(palette, numbers_but_zero(first > 0, second > 0)));
    }
  }
  /// Which indices do not stand for the number 0.
  static Words numbers_but_zero(bool first, bool second) {
    const int others = first || second ? -1 : 0;
    return _mm256_setr_epi32(first ? -1 : 0, second ? -1 : 0, others, others, others, others, others, -1);
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/tile_decoders.inl"

namespace radiosity {

TileDecoder avx2_tile_decoder(const TileFormat& format) {
  return decoder(format);
}

}  // namespace radiosity
#endif
