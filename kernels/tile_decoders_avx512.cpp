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

  /// Four blocks of a row: 32 entries of palettes lie in two registers, where each texel looks its own up.
  template <bool logarithmic>
  static void decode_bc4(const std::uint64_t* blocks, const TileCurve& curve, float* entries) {
    const __m512i four = _mm512_castsi256_si512(_mm256_load_si256(reinterpret_cast<const __m256i*>(blocks)));
    const Vector low =
        bc4_palettes<logarithmic>(_mm512_permutexvar_epi32(lane_pattern<8, 2>(0), four), curve);
    const Vector high =
        bc4_palettes<logarithmic>(_mm512_permutexvar_epi32(lane_pattern<8, 2>(4), four), curve);
    const Words upper = _mm512_permutexvar_epi32(lane_pattern<4, 2>(0), _mm512_srli_epi64(four, 16));
    const Words lower = _mm512_permutexvar_epi32(lane_pattern<4, 2>(0), _mm512_srli_epi64(four, 40));
    const Words first_row = _mm512_setr_epi32(0, 3, 6, 9, 0, 3, 6, 9, 0, 3, 6, 9, 0, 3, 6, 9);
    const Words second_row = _mm512_add_epi32(first_row, _mm512_set1_epi32(12));
    store(entries, choose(low, high, _mm512_srlv_epi32(upper, first_row)));
    store(entries + 64, choose(low, high, _mm512_srlv_epi32(upper, second_row)));
    store(entries + 128, choose(low, high, _mm512_srlv_epi32(lower, first_row)));
    store(entries + 192, choose(low, high, _mm512_srlv_epi32(lower, second_row)));
  }

 private:
  /// first + step (lane / period) in each lane.
  template <int period, int step>
  static Words lane_pattern(int first) {
    const Words lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    constexpr int shift = period == 8 ? 3 : 2;
    const Words steps = _mm512_mullo_epi32(_mm512_srli_epi32(lanes, shift), _mm512_set1_epi32(step));
    return _mm512_add_epi32(steps, _mm512_set1_epi32(first));
  }
  /// The number of each texel's own block, whose index is in the three lowest bits.
  static Vector choose(Vector low, Vector high, Words indices) {
    constexpr int select = 0xea;  // (a & b) | c
    const Words seven = _mm512_set1_epi32(7);
    const Words blocks = lane_pattern<4, 8>(0);
    const Words places = _mm512_ternarylogic_epi32(indices, seven, blocks, select);
    return _mm512_permutex2var_ps(low, places, high);
  }
  static Vector twice(const float* eight) {
    const __m256 half = _mm256_loadu_ps(eight);
    return _mm512_insertf32x8(_mm512_castps256_ps512(half), half, 1);
  }
  /// Those of two blocks, whose lower halves are in eight lanes each.
  template <bool logarithmic>
  static Vector bc4_palettes(Words blocks, const TileCurve& curve) {
    const Words byte = _mm512_set1_epi32(255);
    const Words first = _mm512_and_si512(blocks, byte);
    const Words second = _mm512_and_si512(_mm512_srli_epi32(blocks, 8), byte);
    const __mmask16 six = _mm512_cmple_epi32_mask(first, second);
    const auto weights = [&](const float* of_eight, const float* of_six) {
      return _mm512_mask_blend_ps(six, twice(of_eight), twice(of_six));
    };
    const Vector codes = _mm512_add_ps(
        _mm512_mul_ps(_mm512_cvtepi32_ps(first), weights(bc4_weights[0].first, bc4_weights[1].first)),
        _mm512_mul_ps(_mm512_cvtepi32_ps(second), weights(bc4_weights[0].second, bc4_weights[1].second)));
    return on_curve<logarithmic>(_mm512_mask_add_ps(codes, six, codes, twice(bc4_weights[1].added)), curve);
  }
  template <bool logarithmic>
  static Vector on_curve(Vector codes, const TileCurve& curve) {
    const Vector scaled = _mm512_mul_ps(codes, _mm512_set1_ps(curve.slope));
    if constexpr (!logarithmic) return scaled;
    const __mmask16 some = _mm512_cmp_ps_mask(codes, _mm512_setzero_ps(), _CMP_GT_OQ);
    return _mm512_castsi512_ps(
        _mm512_maskz_cvttps_epi32(some, _mm512_add_ps(scaled, _mm512_set1_ps(curve.base))));
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
