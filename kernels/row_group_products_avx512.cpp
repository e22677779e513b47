#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 warns about its own headers' deliberately undefined vectors (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "kernels/row_group_products.hpp"

#include <immintrin.h>

namespace radiosity {
namespace {

struct Lanes {
  static constexpr bool two_sums = true;
  struct Vector {
    __m512d low, high;
  };

  static Vector zero() { return {_mm512_setzero_pd(), _mm512_setzero_pd()}; }
  static Vector expand(const float* values, unsigned mask) {
    const __m512 all =
        _mm512_mask_expand_ps(cleared(), static_cast<__mmask16>(mask), _mm512_loadu_ps(values));
    return {_mm512_cvtps_pd(_mm512_castps512_ps256(all)), _mm512_cvtps_pd(_mm512_extractf32x8_ps(all, 1))};
  }
  static Vector expand(const double* values, unsigned mask) {
    const unsigned low = mask & 0xff;
    const double* rest = values + __builtin_popcount(low);
    const __m512d none = _mm512_castps_pd(cleared());
    const __m512d none_either = _mm512_castps_pd(cleared());
    return {_mm512_mask_expand_pd(none, static_cast<__mmask8>(low), _mm512_loadu_pd(values)),
            _mm512_mask_expand_pd(none_either, static_cast<__mmask8>(mask >> 8), _mm512_loadu_pd(rest))};
  }
  static Vector multiply_add(Vector a, double x, Vector c) {
    const __m512d all = _mm512_set1_pd(x);
    return {_mm512_fmadd_pd(a.low, all, c.low), _mm512_fmadd_pd(a.high, all, c.high)};
  }
  static Vector add(Vector a, Vector b) {
    return {_mm512_add_pd(a.low, b.low), _mm512_add_pd(a.high, b.high)};
  }
  static Vector load(const double* from) { return {_mm512_loadu_pd(from), _mm512_loadu_pd(from + 8)}; }
  static void store(double* to, Vector vector) {
    _mm512_storeu_pd(to, vector.low);
    _mm512_storeu_pd(to + 8, vector.high);
  }
  static double dot(Vector a, Vector b) {
    return _mm512_reduce_add_pd(_mm512_fmadd_pd(a.low, b.low, _mm512_mul_pd(a.high, b.high)));
  }

 private:
  /// What an expansion writes to: processors have it wait for what was there, even where that is not kept.
  static __m512 cleared() {
    __m512 none = _mm512_setzero_ps();
    __asm__("" : "+v"(none));
    return none;
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/row_group_products.inl"

namespace radiosity {

void get_avx512_row_group_products(RowGroupProducts<double>& f64, RowGroupProducts<float>& f32) {
  get_row_group_products(f64);
  get_row_group_products(f32);
}

}  // namespace radiosity
#endif
