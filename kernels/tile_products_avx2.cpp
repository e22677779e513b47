#if defined(__AVX2__)
#include "kernels/tile_products.hpp"

#include <immintrin.h>

namespace radiosity {
namespace {

template <typename Number>
struct Lanes;

template <>
struct Lanes<double> {
  static constexpr int width = 4;
  using Vector = __m256d;
  static Vector zero() { return _mm256_setzero_pd(); }
  static Vector broadcast(double number) { return _mm256_set1_pd(number); }
  static Vector load(const double* from) { return _mm256_load_pd(from); }
  static void store(double* to, Vector vector) { _mm256_store_pd(to, vector); }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return _mm256_fmadd_pd(a, b, c); }
  static void add_scaled(double* y, Vector vector, double scale) {
    store(y, multiply_add(vector, broadcast(scale), load(y)));
  }
  static Vector row_sums(const double* lanes) {
    const Vector rows01 = _mm256_hadd_pd(load(lanes), load(lanes + 4));       // 0 1 | 0 1
    const Vector rows23 = _mm256_hadd_pd(load(lanes + 8), load(lanes + 12));  // 2 3 | 2 3
    const Vector low = _mm256_permute2f128_pd(rows01, rows23, 0x20);
    const Vector high = _mm256_permute2f128_pd(rows01, rows23, 0x31);
    return _mm256_add_pd(low, high);
  }
};

template <>
struct Lanes<float> {
  static constexpr int width = 8;
  using Vector = __m256;
  static Vector zero() { return _mm256_setzero_ps(); }
  static Vector broadcast(float number) { return _mm256_set1_ps(number); }
  static Vector load(const float* from) { return _mm256_load_ps(from); }
  static Vector load(const Half* from) {
    return _mm256_cvtph_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(from)));
  }
  static void store(float* to, Vector vector) { _mm256_store_ps(to, vector); }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return _mm256_fmadd_ps(a, b, c); }
  static void add_scaled(double* y, Vector vector, double scale) {
    Lanes<double>::add_scaled(y, _mm256_cvtps_pd(_mm256_castps256_ps128(vector)), scale);
    Lanes<double>::add_scaled(y + 4, _mm256_cvtps_pd(_mm256_extractf128_ps(vector, 1)), scale);
  }
  static Vector sums_of_four(const float* lanes) {  // rows 0 1 2 3 | 0 1 2 3
    const Vector rows01 = _mm256_hadd_ps(load(lanes), load(lanes + 8));
    const Vector rows23 = _mm256_hadd_ps(load(lanes + 16), load(lanes + 24));
    return _mm256_hadd_ps(rows01, rows23);
  }
  static Vector row_sums(const float* lanes) {
    const Vector first = sums_of_four(lanes);
    const Vector second = sums_of_four(lanes + 32);
    const Vector low = _mm256_permute2f128_ps(first, second, 0x20);
    const Vector high = _mm256_permute2f128_ps(first, second, 0x31);
    return _mm256_add_ps(low, high);
  }
};

// 16 registers: vectors x columns sums down, one sum across and one broadcast a column, the entries.
template <typename Number, int columns>
constexpr int strip_vectors = columns == 1   ? 8
                              : columns == 2 ? 4
                                             : 2;

}  // namespace
}  // namespace radiosity

#include "kernels/tile_products.inl"

namespace radiosity {

void get_avx2_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16) {
  get_products(f64);
  get_products(f32);
  get_products(f16);
}

}  // namespace radiosity
#endif
