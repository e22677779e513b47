#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 warns about its own headers' deliberately undefined vectors (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "kernels/block_formats.hpp"
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

  /// The palettes of blocks 4 i and 4 i + 1 in low[i], of the two after them in high[i].
  struct Bc4Palettes {
    Vector low[4];
    Vector high[4];
  };

  /// Made side by side, an index a register, and transposed.
  template <bool logarithmic>
  [[gnu::always_inline]] static inline void get_palettes(const std::uint64_t* blocks, const TileCurve& curve,
                                                         Bc4Palettes& palettes) {
    // Lane 4 q + i has block 4 i + q, so that transposing brings blocks 4 i ... 4 i + 3 together.
    const Words places = _mm512_setr_epi32(0, 8, 16, 24, 2, 10, 18, 26, 4, 12, 20, 28, 6, 14, 22, 30);
    Vector entries[8];
    bc4_entries<logarithmic>(
        _mm512_permutex2var_epi32(_mm512_load_si512(blocks), places, _mm512_load_si512(blocks + 8)), curve,
        entries);
    Vector first_four[4];
    Vector last_four[4];
    transpose_quarters(entries, first_four);
    transpose_quarters(entries + 4, last_four);
    const Words first_half = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
    const Words second_half = _mm512_add_epi32(first_half, _mm512_set1_epi32(8));
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      palettes.low[i] = _mm512_permutex2var_ps(first_four[i], first_half, last_four[i]);
      palettes.high[i] = _mm512_permutex2var_ps(first_four[i], second_half, last_four[i]);
    }
  }

  /// Each texel looks its number up in the two registers that hold the palettes of its and three other
  /// blocks.
  [[gnu::always_inline]] static inline void store_bc4(const std::uint64_t* blocks,
                                                      const Bc4Palettes& palettes, float* entries) {
    const Words first_four = four_lanes(2);
    const Words last_four = _mm512_setr_epi32(8, 8, 8, 8, 10, 10, 10, 10, 12, 12, 12, 12, 14, 14, 14, 14);
#pragma GCC unroll 2
    for (int i = 0; i < 4; i += 2) {
      const Words eight = _mm512_load_si512(blocks + 4 * i);
      const Words upper = _mm512_srli_epi64(eight, 16);
      const Words lower = _mm512_srli_epi64(eight, 40);
      float* to = entries + 16 * i;
      store_rows(palettes.low[i], palettes.high[i], _mm512_permutexvar_epi32(first_four, upper), to);
      store_rows(palettes.low[i], palettes.high[i], _mm512_permutexvar_epi32(first_four, lower), to + 128);
      store_rows(palettes.low[i + 1], palettes.high[i + 1], _mm512_permutexvar_epi32(last_four, upper),
                 to + 16);
      store_rows(palettes.low[i + 1], palettes.high[i + 1], _mm512_permutexvar_epi32(last_four, lower),
                 to + 144);
    }
  }

 private:
  /// step (lane / 4) in each lane.
  static Words four_lanes(int step) {
    return _mm512_setr_epi32(0, 0, 0, 0, step, step, step, step, 2 * step, 2 * step, 2 * step, 2 * step,
                             3 * step, 3 * step, 3 * step, 3 * step);
  }
  /// Two rows of texels of four blocks, whose indices are in the lowest 24 bits of four lanes each.
  [[gnu::always_inline]] static inline void store_rows(Vector low, Vector high, Words indices,
                                                       float* entries) {
    constexpr int select = 0xea;  // (a & b) | c
    const Words own =
        _mm512_srlv_epi32(indices, _mm512_setr_epi32(0, 3, 6, 9, 0, 3, 6, 9, 0, 3, 6, 9, 0, 3, 6, 9));
    const Words places =
        _mm512_ternarylogic_epi32(own, _mm512_set1_epi32(0x7007), four_lanes(0x8008), select);
    store(entries, _mm512_permutex2var_ps(low, places, high));
    store(entries + 64, _mm512_permutex2var_ps(low, _mm512_srli_epi32(places, 12), high));
  }

  /// As bc4_numbers has it: entry k of the palettes of sixteen blocks, whose codes are in the lowest 16 bits.
  template <bool logarithmic>
  [[gnu::always_inline]] static inline void bc4_entries(Words blocks, const TileCurve& curve,
                                                        Vector (&entries)[8]) {
    const Words byte = _mm512_set1_epi32(255);
    const Words first = _mm512_and_si512(blocks, byte);
    const Words second = _mm512_and_si512(_mm512_srli_epi32(blocks, 8), byte);
    const __mmask16 eight = _mm512_cmpgt_epi32_mask(first, second);
    const Vector part = _mm512_mask_blend_ps(eight, _mm512_set1_ps(bc4_fifth), _mm512_set1_ps(bc4_seventh));
    const Vector slope = _mm512_set1_ps(curve.slope);
    const Vector A = _mm512_mul_ps(_mm512_cvtepi32_ps(first), slope);
    const Vector B = _mm512_mul_ps(_mm512_cvtepi32_ps(second), slope);
    const Vector top = _mm512_mul_ps(_mm512_set1_ps(255), slope);
    if constexpr (!logarithmic) {
      const Vector step = _mm512_mul_ps(_mm512_sub_ps(B, A), part);
      entries[0] = A;
      entries[1] = B;
#pragma GCC unroll 4
      for (int k = 1; k < 5; ++k)
        entries[k + 1] = _mm512_add_ps(A, _mm512_mul_ps(_mm512_set1_ps(static_cast<float>(k)), step));
      entries[6] = _mm512_maskz_add_ps(eight, A, _mm512_mul_ps(_mm512_set1_ps(5), step));
      entries[7] = _mm512_mask_add_ps(top, eight, A, _mm512_mul_ps(_mm512_set1_ps(6), step));
    } else {
      const Vector base = _mm512_set1_ps(curve.base);
      const Words a = _mm512_cvttps_epi32(_mm512_add_ps(A, base));
      const Words b = _mm512_cvttps_epi32(_mm512_add_ps(B, base));
      const Words step = _mm512_cvttps_epi32(_mm512_mul_ps(_mm512_cvtepi32_ps(_mm512_sub_epi32(b, a)), part));
      const __mmask16 some = _mm512_test_epi32_mask(blocks, _mm512_set1_epi32(0xffff));
      Words words[8];
      words[0] = _mm512_maskz_mov_epi32(_mm512_test_epi32_mask(blocks, byte), a);
      words[1] = _mm512_maskz_mov_epi32(_mm512_test_epi32_mask(blocks, _mm512_set1_epi32(0xff00)), b);
      words[2] = _mm512_maskz_add_epi32(some, a, step);
#pragma GCC unroll 3
      for (int k = 3; k < 6; ++k) words[k] = _mm512_maskz_add_epi32(some, words[k - 1], step);
      words[6] = _mm512_maskz_add_epi32(eight, words[5], step);
      words[7] = _mm512_mask_add_epi32(_mm512_cvttps_epi32(_mm512_add_ps(top, base)), eight, words[6], step);
#pragma GCC unroll 8
      for (int k = 0; k < 8; ++k) entries[k] = _mm512_castsi512_ps(words[k]);
    }
  }

  /// Quarter q of rows[i] is what lane 4 q + i of four registers has.
  [[gnu::always_inline]] static inline void transpose_quarters(const Vector* entries, Vector (&rows)[4]) {
    const __m512d low01 = _mm512_castps_pd(_mm512_unpacklo_ps(entries[0], entries[1]));
    const __m512d high01 = _mm512_castps_pd(_mm512_unpackhi_ps(entries[0], entries[1]));
    const __m512d low23 = _mm512_castps_pd(_mm512_unpacklo_ps(entries[2], entries[3]));
    const __m512d high23 = _mm512_castps_pd(_mm512_unpackhi_ps(entries[2], entries[3]));
    rows[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low01, low23));
    rows[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low01, low23));
    rows[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high01, high23));
    rows[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high01, high23));
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
