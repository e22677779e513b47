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
namespace {

/// The colours of sixteen blocks in one channel, as whole numbers: low + step w, where w is 0, 1, 1/3 or 2/3
/// by the index.
struct LinearBlocks {
  __m512 low;
  __m512 step;
  __m512i indices;

  template <int colour>
  [[gnu::always_inline]] static inline LinearBlocks of(const std::uint64_t* blocks) {
    constexpr int shift = colour == 0 ? 11 : colour == 1 ? 5 : 0;
    const __m512i endpoints = Texels::halves<false>(blocks);
    const __m512i largest = _mm512_set1_epi32(linear_largest<colour>);
    const __m512i first = _mm512_and_si512(_mm512_srli_epi32(endpoints, shift), largest);
    const __m512i second = _mm512_and_si512(_mm512_srli_epi32(endpoints, shift + 16), largest);
    // Steps lead up from the lower of the two colours, so that nothing is subtracted and a texel of 0 adds
    // exactly 0: where the first is above, indices 0 and 1, and 2 and 3, change places.
    const __mmask16 down = _mm512_cmpgt_epi32_mask(first, second);
    const __m512i indices = Texels::halves<true>(blocks);
    return {_mm512_cvtepi32_ps(_mm512_min_epi32(first, second)),
            _mm512_cvtepi32_ps(_mm512_abs_epi32(_mm512_sub_epi32(second, first))),
            _mm512_mask_xor_epi32(indices, down, indices, _mm512_set1_epi32(0x55555555))};
  }

  template <int colour>
  static constexpr int linear_largest = colour == 1 ? 63 : 31;
};

/// Sums of w x over a row of texels, each block in its lane. A permutation reads four bits, two indices, of
/// which one table reads the lower and another the upper, so that indices are shifted once for two texels.
template <int row>
[[gnu::always_inline]] inline __m512 weighted_sum(__m512i indices, const __m512 (&x)[4]) {
  constexpr float third = texture_third;
  constexpr float thirds = 1 - third;
  const __m512 lower =
      _mm512_setr_ps(0, 1, third, thirds, 0, 1, third, thirds, 0, 1, third, thirds, 0, 1, third, thirds);
  const __m512 upper =
      _mm512_setr_ps(0, 0, 0, 0, 1, 1, 1, 1, third, third, third, third, thirds, thirds, thirds, thirds);
  const __m512i left = row == 0 ? indices : _mm512_srli_epi32(indices, 8 * row);
  const __m512i right = _mm512_srli_epi32(indices, 8 * row + 4);
  __m512 sum = _mm512_mul_ps(_mm512_permutexvar_ps(left, lower), x[0]);
  sum = _mm512_fmadd_ps(_mm512_permutexvar_ps(left, upper), x[1], sum);
  sum = _mm512_fmadd_ps(_mm512_permutexvar_ps(right, lower), x[2], sum);
  return _mm512_fmadd_ps(_mm512_permutexvar_ps(right, upper), x[3], sum);
}

/// The sum of the lanes of each.
[[gnu::always_inline]] inline __m128 four_sums(const __m512 (&vectors)[4]) {
  const __m512 first =
      _mm512_add_ps(_mm512_unpacklo_ps(vectors[0], vectors[1]), _mm512_unpackhi_ps(vectors[0], vectors[1]));
  const __m512 last =
      _mm512_add_ps(_mm512_unpacklo_ps(vectors[2], vectors[3]), _mm512_unpackhi_ps(vectors[2], vectors[3]));
  const __m512 quarters =
      _mm512_add_ps(_mm512_shuffle_ps(first, last, 0x44), _mm512_shuffle_ps(first, last, 0xee));
  const __m256 halves = _mm256_add_ps(_mm512_castps512_ps256(quarters), _mm512_extractf32x8_ps(quarters, 1));
  return _mm_add_ps(_mm256_castps256_ps128(halves), _mm256_extractf128_ps(halves, 1));
}

template <int colour>
void multiply_linear_channel(const TextureTask& task, const float* x_of_groups, int stride, double* y) {
  __m512 low = _mm512_setzero_ps();
  __m512 sums[4] = {low, low, low, low};
  for (int group = 0; group < task.groups; ++group) {
    const LinearBlocks blocks = LinearBlocks::of<colour>(task.blocks + 16 * group);
    fetch_blocks_ahead(task.blocks + 16 * group);
    const float* from = x_of_groups + stride * group;
    const __m512 x[4] = {_mm512_load_ps(from), _mm512_load_ps(from + 16), _mm512_load_ps(from + 32),
                         _mm512_load_ps(from + 48)};
    low =
        _mm512_fmadd_ps(blocks.low, _mm512_add_ps(_mm512_add_ps(x[0], x[1]), _mm512_add_ps(x[2], x[3])), low);
    sums[0] = _mm512_fmadd_ps(blocks.step, weighted_sum<0>(blocks.indices, x), sums[0]);
    sums[1] = _mm512_fmadd_ps(blocks.step, weighted_sum<1>(blocks.indices, x), sums[1]);
    sums[2] = _mm512_fmadd_ps(blocks.step, weighted_sum<2>(blocks.indices, x), sums[2]);
    sums[3] = _mm512_fmadd_ps(blocks.step, weighted_sum<3>(blocks.indices, x), sums[3]);
  }
  for (__m512& sum : sums) sum = _mm512_add_ps(low, sum);
  const __m256d parts = _mm256_cvtps_pd(four_sums(sums));
  const __m256d largest = _mm256_set1_pd(LinearBlocks::linear_largest<colour>);
  _mm256_storeu_pd(y, _mm256_add_pd(_mm256_loadu_pd(y), _mm256_div_pd(parts, largest)));
}

void multiply_linear_channel_alone(const TextureTask& task) {
  multiply_linear_channel<1>(task, task.x, texture_group, task.y_rows);
}

void multiply_linear_channels(const TextureTask& task) {
  constexpr int stride = 3 * texture_group;
  multiply_linear_channel<0>(task, task.x, stride, task.y_rows);
  multiply_linear_channel<1>(task, task.x + texture_group, stride, task.y_rows + 4);
  multiply_linear_channel<2>(task, task.x + 2 * texture_group, stride, task.y_rows + 8);
}

}  // namespace

void get_avx512_texture_products(TextureProducts& products) {
  get_texture_products(products);
  products.linear_to_rows[0] = multiply_linear_channel_alone;
  products.linear_to_rows[1] = multiply_linear_channels;
}

}  // namespace radiosity
#endif
