#if defined(__AVX2__) && defined(__FMA__)
#include "kernels/row_group_products.hpp"

#include <immintrin.h>

namespace radiosity {
namespace {

/// For each mask of 8 bits, which number goes to which of 8 places; negative: none.
struct Spreading {
  alignas(8) signed char place[256][8];
};

constexpr Spreading spreading() {
  Spreading result{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    signed char next = 0;
    for (unsigned i = 0; i < 8; ++i) result.place[mask][i] = (mask >> i & 1) != 0 ? next++ : -128;
  }
  return result;
}

constexpr Spreading spread_numbers = spreading();

struct Lanes {
  static constexpr bool two_sums = false;
  struct Vector {
    __m256d quarter[4];
  };

  static Vector zero() {
    const __m256d none = _mm256_setzero_pd();
    return {{none, none, none, none}};
  }

  static Vector expand(const float* values, unsigned mask) {
    const __m256 low = eight(values, mask & 0xff);
    const __m256 high = eight(values + __builtin_popcount(mask & 0xff), mask >> 8);
    return {{_mm256_cvtps_pd(_mm256_castps256_ps128(low)), _mm256_cvtps_pd(_mm256_extractf128_ps(low, 1)),
             _mm256_cvtps_pd(_mm256_castps256_ps128(high)), _mm256_cvtps_pd(_mm256_extractf128_ps(high, 1))}};
  }
  static Vector expand(const double* values, unsigned mask) {
    Vector vector;
    for (unsigned q = 0; q < 4; ++q) {
      const unsigned own = mask >> (4 * q) & 0xf;
      vector.quarter[q] = four(values, own);
      values += __builtin_popcount(own);
    }
    return vector;
  }

  static Vector multiply_add(Vector a, double x, Vector c) {
    const __m256d all = _mm256_set1_pd(x);
    for (int q = 0; q < 4; ++q) c.quarter[q] = _mm256_fmadd_pd(a.quarter[q], all, c.quarter[q]);
    return c;
  }
  static Vector add(Vector a, Vector b) {
    for (int q = 0; q < 4; ++q) a.quarter[q] = _mm256_add_pd(a.quarter[q], b.quarter[q]);
    return a;
  }
  static Vector load(const double* from) {
    Vector vector;
    for (int q = 0; q < 4; ++q) vector.quarter[q] = _mm256_loadu_pd(from + 4 * q);
    return vector;
  }
  static void store(double* to, Vector vector) {
    for (int q = 0; q < 4; ++q) _mm256_storeu_pd(to + 4 * q, vector.quarter[q]);
  }
  static double dot(Vector a, Vector b) {
    __m256d sum = _mm256_mul_pd(a.quarter[0], b.quarter[0]);
    for (int q = 1; q < 4; ++q) sum = _mm256_fmadd_pd(a.quarter[q], b.quarter[q], sum);
    const __m128d two = _mm_add_pd(_mm256_castpd256_pd128(sum), _mm256_extractf128_pd(sum, 1));
    return _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)));
  }

 private:
  static __m256 eight(const float* values, unsigned mask) {
    const __m256i places =
        _mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(spread_numbers.place[mask])));
    const __m256 numbers = _mm256_permutevar8x32_ps(_mm256_loadu_ps(values), places);
    return _mm256_andnot_ps(_mm256_castsi256_ps(_mm256_srai_epi32(places, 31)), numbers);
  }
  static __m256d four(const double* values, unsigned mask) {
    // Halves of a double go together: places 2 p and 2 p + 1.
    const __m256i places =
        _mm256_cvtepi8_epi64(_mm_cvtsi32_si128(*reinterpret_cast<const int*>(spread_numbers.place[mask])));
    const __m256i twice = _mm256_slli_epi64(places, 1);
    const __m256i halves =
        _mm256_or_si256(_mm256_slli_epi64(_mm256_add_epi64(twice, _mm256_set1_epi64x(1)), 32),
                        _mm256_and_si256(twice, _mm256_set1_epi64x(0xffffffff)));
    const __m256d numbers =
        _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(_mm256_loadu_pd(values)), halves));
    return _mm256_andnot_pd(_mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_setzero_si256(), places)), numbers);
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/row_group_products.inl"

namespace radiosity {

void get_avx2_row_group_products(RowGroupProducts<double>& f64, RowGroupProducts<float>& f32) {
  get_row_group_products(f64);
  get_row_group_products(f32);
}

}  // namespace radiosity
#endif
