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

/// A place in sixteen rows of blocks. Four pointers and three distances reach all rows: the compiler is kept
/// from making sixteen pointers of them, which do not fit into its registers.
class RowsOfBlocks {
 public:
  RowsOfBlocks(const std::uint64_t* first, std::ptrdiff_t stride) : stride_(stride), stride3_(3 * stride) {
    for (int q = 0; q < 4; ++q) quarters_[q] = first + 4 * q * stride;
  }

  /// Blocks to the right.
  [[gnu::always_inline]] inline void move(std::ptrdiff_t blocks) {
    for (const std::uint64_t*& quarter : quarters_) {
      quarter += blocks;
      __asm__("" : "+r"(quarter));
    }
  }

  /// A line of each row, ahead of where they are read.
  [[gnu::always_inline]] inline void fetch_ahead() const {
    constexpr int blocks_ahead = 64;
    for (const std::uint64_t* quarter : quarters_) {
      __builtin_prefetch(quarter + blocks_ahead);
      __builtin_prefetch(quarter + stride_ + blocks_ahead);
      __builtin_prefetch(quarter + 2 * stride_ + blocks_ahead);
      __builtin_prefetch(quarter + stride3_ + blocks_ahead);
    }
  }

  /// Two blocks of each of the rows k, 4 + k, 8 + k and 12 + k.
  template <int k>
  [[gnu::always_inline]] inline __m512i two_columns() const {
    const std::ptrdiff_t row = k == 3 ? stride3_ : k * stride_;
    const auto two_blocks = [&](int q) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(quarters_[q] + row));
    };
    __m512i rows = _mm512_zextsi128_si512(two_blocks(0));
    rows = _mm512_mask_broadcast_i32x4(rows, 0x00f0, two_blocks(1));
    rows = _mm512_mask_broadcast_i32x4(rows, 0x0f00, two_blocks(2));
    return _mm512_mask_broadcast_i32x4(rows, 0xf000, two_blocks(3));
  }

 private:
  const std::uint64_t* quarters_[4];
  std::ptrdiff_t stride_;
  std::ptrdiff_t stride3_;
};

/// Two columns of blocks of sixteen rows of blocks, a row in each lane.
struct BlockPair {
  __m512i endpoints[2];
  __m512i indices[2];

  [[gnu::always_inline]] static inline BlockPair of(const RowsOfBlocks& at) {
    const __m512i rows[4] = {at.two_columns<0>(), at.two_columns<1>(), at.two_columns<2>(),
                             at.two_columns<3>()};
    const __m512i left[2] = {_mm512_unpacklo_epi32(rows[0], rows[1]),
                             _mm512_unpacklo_epi32(rows[2], rows[3])};
    const __m512i right[2] = {_mm512_unpackhi_epi32(rows[0], rows[1]),
                              _mm512_unpackhi_epi32(rows[2], rows[3])};
    return {{_mm512_unpacklo_epi64(left[0], left[1]), _mm512_unpacklo_epi64(right[0], right[1])},
            {_mm512_unpackhi_epi64(left[0], left[1]), _mm512_unpackhi_epi64(right[0], right[1])}};
  }
};

/// Sums of a channel over columns of blocks, a row of blocks in each lane. A texel is low + step w in whole
/// numbers, where w is 0, 1, 1/3 or 2/3 by its index.
template <int colour>
struct LinearSums {
  static constexpr int largest = colour == 1 ? 63 : 31;

  __m512 low = _mm512_setzero_ps();
  __m512 rows[4] = {low, low, low, low};

  [[gnu::always_inline]] inline void add(__m512i endpoints, __m512i indices, const float* weighted) {
    constexpr int shift = colour == 0 ? 11 : colour == 1 ? 5 : 0;
    const __m512i mask = _mm512_set1_epi32(largest);
    const __m512i first = _mm512_and_si512(_mm512_srli_epi32(endpoints, shift), mask);
    const __m512i second = _mm512_and_si512(_mm512_srli_epi32(endpoints, shift + 16), mask);
    // Steps lead up from the lower of the two colours, so that nothing is subtracted and a texel of 0 adds
    // exactly 0: where the first is above, indices 0 and 1, and 2 and 3, change places.
    const __mmask16 down = _mm512_cmpgt_epi32_mask(first, second);
    indices = _mm512_mask_xor_epi32(indices, down, indices, _mm512_set1_epi32(0x55555555));
    const __m512 step = _mm512_cvtepi32_ps(_mm512_abs_epi32(_mm512_sub_epi32(second, first)));
    low = _mm512_fmadd_ps(_mm512_cvtepi32_ps(_mm512_min_epi32(first, second)), _mm512_set1_ps(weighted[32]),
                          low);
    const __m512 left = _mm512_load_ps(weighted);
    const __m512 right = _mm512_load_ps(weighted + 16);
    rows[0] = _mm512_fmadd_ps(step, weighted_sum<0>(indices, left, right), rows[0]);
    rows[1] = _mm512_fmadd_ps(step, weighted_sum<1>(indices, left, right), rows[1]);
    rows[2] = _mm512_fmadd_ps(step, weighted_sum<2>(indices, left, right), rows[2]);
    rows[3] = _mm512_fmadd_ps(step, weighted_sum<3>(indices, left, right), rows[3]);
  }

  /// y[16 r + lane] += the sums of row r.
  void give(double* y) const {
    const __m512d inverse = _mm512_set1_pd(1.0 / largest);
    for (int r = 0; r < 4; ++r) {
      const __m512 sums = _mm512_add_ps(low, rows[r]);
      double* to = y + 16 * r;
      add_product(_mm512_castps512_ps256(sums), inverse, to);
      add_product(_mm512_extractf32x8_ps(sums, 1), inverse, to + 8);
    }
  }

 private:
  /// A permutation reads the lowest four bits of a lane: the indices of two texels.
  template <int row>
  [[gnu::always_inline]] static inline __m512 weighted_sum(__m512i indices, __m512 left, __m512 right) {
    const __m512i lowest = row == 0 ? indices : _mm512_srli_epi32(indices, 8 * row);
    return _mm512_add_ps(_mm512_permutexvar_ps(lowest, left),
                         _mm512_permutexvar_ps(_mm512_srli_epi32(indices, 8 * row + 4), right));
  }
  static void add_product(__m256 sums, __m512d factor, double* y) {
    _mm512_storeu_pd(y, _mm512_fmadd_pd(_mm512_cvtps_pd(sums), factor, _mm512_loadu_pd(y)));
  }
};

/// What all channels have of a run of columns of blocks.
template <int... colours>
class LinearRun : private LinearSums<colours>... {
 public:
  static constexpr int numbers = static_cast<int>(sizeof...(colours)) * linear_numbers;  ///< a column

  [[gnu::always_inline]] inline void add(const BlockPair& pair, const float* weighted) {
    for (int c = 0; c < 2; ++c) {
      int channel = 0;
      (LinearSums<colours>::add(pair.endpoints[c], pair.indices[c],
                                weighted + c * numbers + linear_numbers * channel++),
       ...);
    }
  }
  void give(double* y) const {
    int channel = 0;
    (LinearSums<colours>::give(y + 64 * channel++), ...);
  }
};

template <int... colours>
void multiply_linear_strip(const LinearStrip& strip) {
  constexpr int line = 8;
  constexpr int columns_of_a_run = 64;  // whose products are added up in float
  const float* weighted = strip.weighted;
  RowsOfBlocks at(strip.blocks, strip.row_stride);
  for (int begin = 0; begin < strip.block_columns; begin += columns_of_a_run) {
    const int end =
        strip.block_columns - begin < columns_of_a_run ? strip.block_columns : begin + columns_of_a_run;
    LinearRun<colours...> run;
    for (int column = begin; column < end; column += line) {
      at.fetch_ahead();
#pragma GCC unroll 1
      for (int pair = 0; pair < line / 2; ++pair) {
        run.add(BlockPair::of(at), weighted);
        at.move(2);
        weighted += 2 * LinearRun<colours...>::numbers;
      }
    }
    run.give(strip.y);
  }
}

}  // namespace

void get_avx512_texture_products(TextureProducts& products) {
  get_texture_products(products);
  products.linear_strip[0] = multiply_linear_strip<1>;
  products.linear_strip[1] = multiply_linear_strip<0, 1, 2>;
}

}  // namespace radiosity
#endif
