#if defined(__AVX512F__)
#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 warns about its own headers' deliberately undefined vectors (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "kernels/bc4_row_avx512.inl"
#include "kernels/tile_products.hpp"

#include <immintrin.h>

namespace radiosity {
namespace {

template <typename Number>
struct Lanes;

template <>
struct Lanes<double> {
  static constexpr int width = 8;
  using Vector = __m512d;
  static Vector zero() { return _mm512_setzero_pd(); }
  static Vector broadcast(double number) { return _mm512_set1_pd(number); }
  static Vector load(const double* from) { return _mm512_load_pd(from); }
  static void store(double* to, Vector vector) { _mm512_store_pd(to, vector); }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return _mm512_fmadd_pd(a, b, c); }
  static void add_scaled(double* y, Vector vector, double scale) {
    store(y, multiply_add(vector, broadcast(scale), load(y)));
  }

  static Vector sums_of_two(const double* lanes) {  // rows 0 1 | 0 1 | 0 1 | 0 1
    const Vector row0 = load(lanes);
    const Vector row1 = load(lanes + 8);
    return _mm512_add_pd(_mm512_unpacklo_pd(row0, row1), _mm512_unpackhi_pd(row0, row1));
  }
  static Vector add_quarters(Vector a, Vector b) {  // a0+a1, a2+a3, b0+b1, b2+b3 in quarters of a vector
    return _mm512_add_pd(_mm512_shuffle_f64x2(a, b, 0x88), _mm512_shuffle_f64x2(a, b, 0xdd));
  }
  static Vector row_sums(const double* lanes) {
    const Vector first = add_quarters(sums_of_two(lanes), sums_of_two(lanes + 16));
    const Vector second = add_quarters(sums_of_two(lanes + 32), sums_of_two(lanes + 48));
    return add_quarters(first, second);
  }
};

template <>
struct Lanes<float> {
  static constexpr int width = 16;
  using Vector = __m512;
  static Vector zero() { return _mm512_setzero_ps(); }
  static Vector broadcast(float number) { return _mm512_set1_ps(number); }
  static Vector load(const float* from) { return _mm512_load_ps(from); }
  static Vector load(const Half* from) {
    return _mm512_cvtph_ps(_mm256_load_si256(reinterpret_cast<const __m256i*>(from)));
  }
  static void store(float* to, Vector vector) { _mm512_store_ps(to, vector); }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return _mm512_fmadd_ps(a, b, c); }
  static void add_scaled(double* y, Vector vector, double scale) {
    Lanes<double>::add_scaled(y, _mm512_cvtps_pd(_mm512_castps512_ps256(vector)), scale);
    Lanes<double>::add_scaled(y + 8, _mm512_cvtps_pd(_mm512_extractf32x8_ps(vector, 1)), scale);
  }

  static Vector sums_of_two(const float* lanes) {  // rows 0 1 0 1 in each quarter
    const Vector row0 = load(lanes);
    const Vector row1 = load(lanes + 16);
    return _mm512_add_ps(_mm512_unpacklo_ps(row0, row1), _mm512_unpackhi_ps(row0, row1));
  }
  static Vector sums_of_four(const float* lanes) {  // rows 0 1 2 3 in each quarter
    const __m512d first = _mm512_castps_pd(sums_of_two(lanes));
    const __m512d second = _mm512_castps_pd(sums_of_two(lanes + 32));
    return _mm512_add_ps(_mm512_castpd_ps(_mm512_unpacklo_pd(first, second)),
                         _mm512_castpd_ps(_mm512_unpackhi_pd(first, second)));
  }
  static Vector add_quarters(Vector a, Vector b) {  // a0+a1, a2+a3, b0+b1, b2+b3 in quarters of a vector
    return _mm512_add_ps(_mm512_shuffle_f32x4(a, b, 0x88), _mm512_shuffle_f32x4(a, b, 0xdd));
  }
  static Vector row_sums(const float* lanes) {
    const Vector first = add_quarters(sums_of_four(lanes), sums_of_four(lanes + 64));
    const Vector second = add_quarters(sums_of_four(lanes + 128), sums_of_four(lanes + 192));
    return add_quarters(first, second);
  }
};

// 32 registers: vectors x columns sums down, one sum across and one broadcast a column, the entries.
template <typename Number, int columns>
constexpr int strip_vectors = 64 / Lanes<Number>::width;

}  // namespace
}  // namespace radiosity

#include "kernels/tile_products.inl"

namespace radiosity {
namespace {

/// A tile of BC4 blocks, decoded in registers: stored to a panel and loaded again its numbers take half as
/// much time again.
template <bool logarithmic>
class Bc4Entries {
 public:
  using Task = TileTask<Bc4Block>;
  using Number = float;

  explicit Bc4Entries(const Task& task)
      : blocks_(reinterpret_cast<const std::uint64_t*>(task.entries)),
        prefetch_(task.prefetch),
        curve_(*task.curve) {}

  /// The palettes of a row of blocks are made while the texels of the one before it are multiplied: by itself
  /// each is a chain of operations that wait for each other.
  template <int vectors, typename Visit>
  [[gnu::always_inline]] inline void visit_rows(int, Visit visit) const {
    static_assert(vectors == 4);
    const std::uint64_t* blocks = blocks_;
    Bc4Row even;
    Bc4Row odd;
    even.get_palettes<logarithmic>(blocks, curve_);
    for (int r = 0; r < block; r += 8, blocks += 32) {
      for (int line = 0; line < 4; ++line) __builtin_prefetch(prefetch_ + r * 32 + line * 64);
      odd.get_palettes<logarithmic>(blocks + 16, curve_);
      visit_texels(r, blocks, even, visit);
      if (r + 8 < block) even.get_palettes<logarithmic>(blocks + 32, curve_);
      visit_texels(r + 4, blocks + 16, odd, visit);
    }
  }

 private:
  template <typename Visit>
  [[gnu::always_inline]] static inline void visit_texels(int r, const std::uint64_t* blocks,
                                                         const Bc4Row& palettes, Visit visit) {
#pragma GCC unroll 2
    for (int pair = 0; pair < 2; ++pair) {
      const Bc4Row::TwoRows rows = Bc4Row::two_rows(blocks, pair);
      visit(
          r + 2 * pair, [&](int v) __attribute__((always_inline)) { return rows.first(palettes, v); });
      visit(
          r + 2 * pair + 1, [&](int v) __attribute__((always_inline)) { return rows.second(palettes, v); });
    }
  }

  const std::uint64_t* blocks_;
  const char* prefetch_;
  TileCurve curve_;
};

}  // namespace

void get_avx512_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16) {
  get_products(f64);
  get_products(f32);
  get_products(f16);
}

void get_avx512_products(TileProducts<Bc4Block>& linear, TileProducts<Bc4Block>& logarithmic) {
  get_products<Bc4Entries<false>>(linear);
  get_products<Bc4Entries<true>>(logarithmic);
}

}  // namespace radiosity
#endif
