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

  /// Four blocks of a row: a block's palette fills a register, where two rows of texels look theirs up.
  template <bool logarithmic>
  static void decode_bc4(const std::uint64_t* blocks, const TileCurve& curve, float* entries) {
    const Words shifts = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
    for (int b = 0; b < 4; ++b) {
      const Vector palette = bc4_palette<logarithmic>(blocks[b], curve);
      for (int half = 0; half < 2; ++half) {
        const Words bits = _mm256_set1_epi32(static_cast<int>(blocks[b] >> (16 + 24 * half)));
        const Vector texels = _mm256_permutevar8x32_ps(palette, _mm256_srlv_epi32(bits, shifts));
        float* rows = entries + 128 * half + 4 * b;
        _mm_store_ps(rows, _mm256_castps256_ps128(texels));
        _mm_store_ps(rows + 64, _mm256_extractf128_ps(texels, 1));
      }
    }
  }

 private:
  template <bool logarithmic>
  static Vector bc4_palette(std::uint64_t block, const TileCurve& curve) {
    const auto first = static_cast<float>(block & 255);
    const auto second = static_cast<float>(block >> 8 & 255);
    const Bc4Weights& weights = bc4_weights[first > second ? 0 : 1];
    const Vector codes =
        _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(_mm256_set1_ps(first), _mm256_loadu_ps(weights.first)),
                                    _mm256_mul_ps(_mm256_set1_ps(second), _mm256_loadu_ps(weights.second))),
                      _mm256_loadu_ps(weights.added));
    const Vector scaled = _mm256_mul_ps(codes, _mm256_set1_ps(curve.slope));
    if constexpr (!logarithmic) return scaled;
    const Words words = _mm256_cvttps_epi32(_mm256_add_ps(scaled, _mm256_set1_ps(curve.base)));
    return _mm256_and_ps(_mm256_castsi256_ps(words), _mm256_cmp_ps(codes, _mm256_setzero_ps(), _CMP_GT_OQ));
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
