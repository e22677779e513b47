// A row of BC4 blocks in AVX-512 registers, for the decoder and for the product that decodes as it
// multiplies.

#include "kernels/block_formats.hpp"
#include "kernels/tile_format.hpp"

#include <cstdint>
#include <immintrin.h>

namespace radiosity {
namespace {

/// The palettes of sixteen blocks side by side, and their texels, 4 rows of 64.
class Bc4Row {
 public:
  using Words = __m512i;
  using Vector = __m512;

  /// Palettes are made side by side, an index a register, and transposed.
  template <bool logarithmic>
  [[gnu::always_inline]] inline void get_palettes(const std::uint64_t* blocks, const TileCurve& curve) {
    // Lane 4 q + i has block 4 i + q, so that transposing brings blocks 4 i ... 4 i + 3 together.
    const Words places = _mm512_setr_epi32(0, 8, 16, 24, 2, 10, 18, 26, 4, 12, 20, 28, 6, 14, 22, 30);
    Vector entries[8];
    get_entries<logarithmic>(
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
      low_[i] = _mm512_permutex2var_ps(first_four[i], first_half, last_four[i]);
      high_[i] = _mm512_permutex2var_ps(first_four[i], second_half, last_four[i]);
    }
  }

  /// Where the texels of two rows look their numbers up.
  struct TwoRows {
    Words places[4];

    /// Vector v of the first row: blocks 4 v ... 4 v + 3.
    [[gnu::always_inline]] inline Vector first(const Bc4Row& palettes, int v) const {
      return _mm512_permutex2var_ps(palettes.low_[v], places[v], palettes.high_[v]);
    }
    [[gnu::always_inline]] inline Vector second(const Bc4Row& palettes, int v) const {
      return _mm512_permutex2var_ps(palettes.low_[v], _mm512_srli_epi32(places[v], 12), palettes.high_[v]);
    }
  };

  /// Rows 0 and 1 (pair 0) or 2 and 3 (pair 1) of the blocks.
  [[gnu::always_inline]] static inline TwoRows two_rows(const std::uint64_t* blocks, int pair) {
    const Words first_four = four_lanes(0, 2);
    const Words last_four = four_lanes(8, 2);
    TwoRows rows;
#pragma GCC unroll 2
    for (int i = 0; i < 4; i += 2) {
      const Words indices = _mm512_srli_epi64(_mm512_load_si512(blocks + 4 * i), pair == 0 ? 16 : 40);
      rows.places[i] = places_of(_mm512_permutexvar_epi32(first_four, indices));
      rows.places[i + 1] = places_of(_mm512_permutexvar_epi32(last_four, indices));
    }
    return rows;
  }

 private:
  /// first + step (lane / 4) in each lane.
  static Words four_lanes(int first, int step) {
    const int a = first;
    const int b = first + step;
    const int c = first + 2 * step;
    const int d = first + 3 * step;
    return _mm512_setr_epi32(a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d);
  }
  /// Of two rows of texels of four blocks, whose indices are in the lowest 24 bits of four lanes each: the
  /// first row's in bits 0 ... 4, the second row's from bit 12 on.
  [[gnu::always_inline]] static inline Words places_of(Words indices) {
    constexpr int select = 0xea;  // (a & b) | c
    const Words own =
        _mm512_srlv_epi32(indices, _mm512_setr_epi32(0, 3, 6, 9, 0, 3, 6, 9, 0, 3, 6, 9, 0, 3, 6, 9));
    return _mm512_ternarylogic_epi32(own, _mm512_set1_epi32(0x7007), four_lanes(0, 0x8008), select);
  }

  /// As bc4_numbers has it: entry k of the palettes of sixteen blocks, whose codes are in the lowest 16 bits.
  template <bool logarithmic>
  [[gnu::always_inline]] static inline void get_entries(Words blocks, const TileCurve& curve,
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

  Vector low_[4];   ///< palettes of the blocks 4 i and 4 i + 1
  Vector high_[4];  ///< ... and of the two after them
};

}  // namespace
}  // namespace radiosity
