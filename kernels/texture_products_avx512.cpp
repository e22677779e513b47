#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 warns about its own headers' deliberately undefined vectors (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "kernels/texture_products.hpp"

#include <immintrin.h>

namespace radiosity {
namespace {

struct Texels {
  static constexpr int width = 16;
  using Vector = __m512;
  using Words = __m512i;

  static Vector zero() { return _mm512_setzero_ps(); }
  static Vector broadcast(float number) { return _mm512_set1_ps(number); }
  static Vector load(const float* from) { return _mm512_load_ps(from); }
  static void store(float* to, Vector vector) { _mm512_store_ps(to, vector); }
  static Words load_words(const std::uint32_t* from) { return _mm512_load_si512(from); }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return _mm512_fmadd_ps(a, b, c); }
  static double sum(Vector vector) { return static_cast<double>(_mm512_reduce_add_ps(vector)); }

  template <int row>
  static Words indices(Words words) {
    constexpr int s = 8 * row;
    return _mm512_srlv_epi32(words, _mm512_setr_epi32(s, s + 2, s + 4, s + 6, s, s + 2, s + 4, s + 6, s,
                                                      s + 2, s + 4, s + 6, s, s + 2, s + 4, s + 6));
  }
  static Vector select(Vector palettes, Words indices) { return _mm512_permutevar_ps(palettes, indices); }

  /// The low or the high halves of sixteen blocks.
  template <bool high>
  [[gnu::always_inline]] static inline Words halves(const std::uint64_t* blocks) {
    constexpr int h = high ? 1 : 0;
    const Words places = _mm512_setr_epi32(h, h + 2, h + 4, h + 6, h + 8, h + 10, h + 12, h + 14, h + 16,
                                           h + 18, h + 20, h + 22, h + 24, h + 26, h + 28, h + 30);
    return _mm512_permutex2var_epi32(_mm512_loadu_si512(blocks), places, _mm512_loadu_si512(blocks + 8));
  }

  [[gnu::always_inline]] static inline void spread_indices(const std::uint64_t* blocks,
                                                           std::uint32_t* words) {
    const Words indices = halves<true>(blocks);
    _mm512_store_si512(words, _mm512_shuffle_epi32(indices, _MM_PERM_AAAA));
    _mm512_store_si512(words + 16, _mm512_shuffle_epi32(indices, _MM_PERM_BBBB));
    _mm512_store_si512(words + 32, _mm512_shuffle_epi32(indices, _MM_PERM_CCCC));
    _mm512_store_si512(words + 48, _mm512_shuffle_epi32(indices, _MM_PERM_DDDD));
  }

  template <int colour, bool logarithmic>
  [[gnu::always_inline]] static inline void palettes(const std::uint64_t* blocks, const float* table,
                                                     float* numbers) {
    constexpr int shift = colour == 0 ? 11 : colour == 1 ? 5 : 0;
    constexpr int largest = colour == 1 ? 63 : 31;
    const Words endpoints = halves<false>(blocks);
    const Vector A = look_up<largest>(table, _mm512_srli_epi32(endpoints, shift));
    const Vector B = look_up<largest>(table, _mm512_srli_epi32(endpoints, shift + 16));
    Vector entries[4];
    if constexpr (logarithmic) {
      const Vector AA = _mm512_mul_ps(A, A);
      const Vector BB = _mm512_mul_ps(B, B);
      const __mmask16 first = _mm512_test_epi32_mask(endpoints, _mm512_set1_epi32(largest << shift));
      const __mmask16 second = _mm512_test_epi32_mask(
          endpoints, _mm512_set1_epi32(static_cast<int>(static_cast<unsigned>(largest) << (shift + 16))));
      const __mmask16 either = _kor_mask16(first, second);
      entries[0] = _mm512_maskz_mul_ps(first, AA, A);
      entries[1] = _mm512_maskz_mul_ps(second, BB, B);
      entries[2] = _mm512_maskz_mul_ps(either, AA, B);
      entries[3] = _mm512_maskz_mul_ps(either, A, BB);
    } else {
      const Vector third = _mm512_set1_ps(texture_third);
      const Vector A_third = _mm512_mul_ps(A, third);
      const Vector B_third = _mm512_mul_ps(B, third);
      entries[0] = A;
      entries[1] = B;
      entries[2] = _mm512_add_ps(_mm512_add_ps(A_third, A_third), B_third);
      entries[3] = _mm512_add_ps(A_third, _mm512_add_ps(B_third, B_third));
    }
    const __m512d low01 = _mm512_castps_pd(_mm512_unpacklo_ps(entries[0], entries[1]));
    const __m512d high01 = _mm512_castps_pd(_mm512_unpackhi_ps(entries[0], entries[1]));
    const __m512d low23 = _mm512_castps_pd(_mm512_unpacklo_ps(entries[2], entries[3]));
    const __m512d high23 = _mm512_castps_pd(_mm512_unpackhi_ps(entries[2], entries[3]));
    store(numbers, _mm512_castpd_ps(_mm512_unpacklo_pd(low01, low23)));
    store(numbers + 16, _mm512_castpd_ps(_mm512_unpackhi_pd(low01, low23)));
    store(numbers + 32, _mm512_castpd_ps(_mm512_unpacklo_pd(high01, high23)));
    store(numbers + 48, _mm512_castpd_ps(_mm512_unpackhi_pd(high01, high23)));
  }

 private:
  /// The numbers of codes in the lowest five or six bits.
  template <int largest>
  [[gnu::always_inline]] static inline Vector look_up(const float* table, Words codes) {
    const Vector low = _mm512_permutex2var_ps(load(table), codes, load(table + 16));
    if constexpr (largest < 32) return low;
    const Vector high = _mm512_permutex2var_ps(load(table + 32), codes, load(table + 48));
    return _mm512_mask_blend_ps(_mm512_test_epi32_mask(codes, _mm512_set1_epi32(32)), low, high);
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/texture_products.inl"

namespace radiosity {

void get_avx512_texture_products(TextureProducts& products) {
  get_texture_products(products);
}

}  // namespace radiosity
#endif
