#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 warns about its own headers' deliberately undefined vectors (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "kernels/bc4_row_avx512.inl"
#include "kernels/tile_decoders.hpp"

#include <cstdint>
#include <cstring>
#include <immintrin.h>
#include <utility>

namespace radiosity {
namespace {

struct Codes {
  static constexpr int width = 16;
  using Words = __m512i;
  using Vector = __m512;

  static Words load_words(const std::uint32_t* from) { return _mm512_load_si512(from); }
  static void store(float* to, Vector vector) { _mm512_store_ps(to, vector); }
  static void widen(const std::uint16_t* halves, float* steps, int count) {
    for (int k = 0; k < count; k += 16)
      store(steps + k, _mm512_cvtph_ps(_mm256_load_si256(reinterpret_cast<const __m256i*>(halves + k))));
  }

  /// Codes of up to four bits look their number up in a register: the permutation reads the lowest four bits
  /// of a word, and with two-bit codes the table repeats itself four times, so that what follows does not
  /// count.
  template <int bits>
  static Vector steps(float step) {
    const Vector all = _mm512_set1_ps(step);
    if constexpr (bits == 8)
      return all;
    else if constexpr (bits == 4)
      return _mm512_mul_ps(all, _mm512_setr_ps(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    else
      return _mm512_mul_ps(all, _mm512_setr_ps(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3));
  }
  template <int bits, int shift>
  static Vector decode(Words words, Vector steps) {
    const Words shifted = shift == 0 ? words : _mm512_srli_epi32(words, shift);
    if constexpr (bits == 8)
      return _mm512_mul_ps(_mm512_cvtepi32_ps(_mm512_and_si512(shifted, _mm512_set1_epi32(255))), steps);
    else
      return _mm512_permutexvar_ps(shifted, steps);
  }

  // BC4 blocks, as tile_decoders.inl asks for them.
  using Bc4Palettes = Bc4Row;
  template <bool logarithmic>
  [[gnu::always_inline]] static inline void get_palettes(const std::uint64_t* blocks, const TileCurve& curve,
                                                         Bc4Palettes& palettes) {
    palettes.get_palettes<logarithmic>(blocks, curve);
  }
  [[gnu::always_inline]] static inline void store_bc4(const std::uint64_t* blocks,
                                                      const Bc4Palettes& palettes, float* entries) {
#pragma GCC unroll 2
    for (int pair = 0; pair < 2; ++pair) {
      const Bc4Row::TwoRows rows = palettes.two_rows(blocks, pair);
#pragma GCC unroll 4
      for (int v = 0; v < 4; ++v) {
        store(entries + 128 * pair + 16 * v, rows.first(palettes, v));
        store(entries + 128 * pair + 64 + 16 * v, rows.second(palettes, v));
      }
    }
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/tile_decoders.inl"

namespace radiosity {

TileDecoder avx512_tile_decoder(const TileFormat& format) {
  return decoder(format);
}

}  // namespace radiosity
#endif
