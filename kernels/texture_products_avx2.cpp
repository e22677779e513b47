#if defined(__AVX2__) && defined(__FMA__)
#include "kernels/texture_products.hpp"

#include <immintrin.h>

namespace radiosity {
namespace {

struct Texels {
  static constexpr int width = 8;
  using Vector = __m256;
  using Words = __m256i;

  static Vector zero() { return _mm256_setzero_ps(); }
  static Vector broadcast(float number) { return _mm256_set1_ps(number); }
  static Vector load(const float* from) { return _mm256_load_ps(from); }
  static void store(float* to, Vector vector) { _mm256_store_ps(to, vector); }
  static Words load_words(const std::uint32_t* from) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
  }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return _mm256_fmadd_ps(a, b, c); }
  static double sum(Vector vector) {
    const __m128 four = _mm_add_ps(_mm256_castps256_ps128(vector), _mm256_extractf128_ps(vector, 1));
    const __m128 two = _mm_add_ps(four, _mm_movehl_ps(four, four));
    return static_cast<double>(_mm_cvtss_f32(_mm_add_ss(two, _mm_movehdup_ps(two))));
  }

  template <int row>
  static Words indices(Words words) {
    constexpr int s = 8 * row;
    return _mm256_srlv_epi32(words, _mm256_setr_epi32(s, s + 2, s + 4, s + 6, s, s + 2, s + 4, s + 6));
  }
  static Vector select(Vector palettes, Words indices) { return _mm256_permutevar_ps(palettes, indices); }

  /// The low or the high halves of eight blocks.
  template <bool high>
  static Words halves(const std::uint64_t* blocks) {
    const __m256i four = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(blocks));
    const __m256i next = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(blocks + 4));
    const __m256 mixed =
        _mm256_shuffle_ps(_mm256_castsi256_ps(four), _mm256_castsi256_ps(next), high ? 0xdd : 0x88);
    return _mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8);
  }

  static void spread_indices(const std::uint64_t* blocks, std::uint32_t* words) {
    for (int half = 0; half < 2; ++half) {
      const __m256i indices = halves<true>(blocks + 8 * half);
      auto* to = reinterpret_cast<__m256i*>(words + 8 * half);
      _mm256_store_si256(to, _mm256_shuffle_epi32(indices, 0x00));
      _mm256_store_si256(to + 2, _mm256_shuffle_epi32(indices, 0x55));
      _mm256_store_si256(to + 4, _mm256_shuffle_epi32(indices, 0xaa));
      _mm256_store_si256(to + 6, _mm256_shuffle_epi32(indices, 0xff));
    }
  }

  template <int colour, bool logarithmic>
  static void palettes(const std::uint64_t* blocks, const float* table, float* numbers) {
    for (int half = 0; half < 2; ++half)
      palettes_of_eight<colour, logarithmic>(halves<false>(blocks + 8 * half), table, numbers + 8 * half);
  }

 private:
  template <int colour, bool logarithmic>
  [[gnu::always_inline]] static inline void palettes_of_eight(Words endpoints, const float* table,
                                                              float* numbers) {
    constexpr int shift = colour == 0 ? 11 : colour == 1 ? 5 : 0;
    const Words largest = _mm256_set1_epi32(colour == 1 ? 63 : 31);
    const Words first = _mm256_and_si256(_mm256_srli_epi32(endpoints, shift), largest);
    const Words second = _mm256_and_si256(_mm256_srli_epi32(endpoints, shift + 16), largest);
    const Vector A = _mm256_i32gather_ps(table, first, 4);
    const Vector B = _mm256_i32gather_ps(table, second, 4);
    Vector entries[4];
    if constexpr (logarithmic) {
      const Vector AA = _mm256_mul_ps(A, A);
      const Vector BB = _mm256_mul_ps(B, B);
      const Words none = _mm256_setzero_si256();
      const Vector first_is_0 = _mm256_castsi256_ps(_mm256_cmpeq_epi32(first, none));
      const Vector second_is_0 = _mm256_castsi256_ps(_mm256_cmpeq_epi32(second, none));
      const Vector both_are_0 = _mm256_and_ps(first_is_0, second_is_0);
      entries[0] = _mm256_andnot_ps(first_is_0, _mm256_mul_ps(AA, A));
      entries[1] = _mm256_andnot_ps(second_is_0, _mm256_mul_ps(BB, B));
      entries[2] = _mm256_andnot_ps(both_are_0, _mm256_mul_ps(AA, B));
      entries[3] = _mm256_andnot_ps(both_are_0, _mm256_mul_ps(A, BB));
    } else {
      const Vector third = _mm256_set1_ps(texture_third);
      const Vector A_third = _mm256_mul_ps(A, third);
      const Vector B_third = _mm256_mul_ps(B, third);
      entries[0] = A;
      entries[1] = B;
      entries[2] = _mm256_add_ps(_mm256_add_ps(A_third, A_third), B_third);
      entries[3] = _mm256_add_ps(A_third, _mm256_add_ps(B_third, B_third));
    }
    const __m256d low01 = _mm256_castps_pd(_mm256_unpacklo_ps(entries[0], entries[1]));
    const __m256d high01 = _mm256_castps_pd(_mm256_unpackhi_ps(entries[0], entries[1]));
    const __m256d low23 = _mm256_castps_pd(_mm256_unpacklo_ps(entries[2], entries[3]));
    const __m256d high23 = _mm256_castps_pd(_mm256_unpackhi_ps(entries[2], entries[3]));
    store(numbers, _mm256_castpd_ps(_mm256_unpacklo_pd(low01, low23)));
    store(numbers + 16, _mm256_castpd_ps(_mm256_unpackhi_pd(low01, low23)));
    store(numbers + 32, _mm256_castpd_ps(_mm256_unpacklo_pd(high01, high23)));
    store(numbers + 48, _mm256_castpd_ps(_mm256_unpackhi_pd(high01, high23)));
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/texture_products.inl"

namespace radiosity {

void get_avx2_texture_products(TextureProducts& products) {
  get_texture_products(products);
}

}  // namespace radiosity
#endif
