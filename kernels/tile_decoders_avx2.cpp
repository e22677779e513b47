#if defined(__AVX2__)
#include "kernels/tile_decoders.hpp"

#include <cstdint>
#include <immintrin.h>
#include <utility>

namespace radiosity {
namespace {

struct Codes {
  static constexpr int width = 8;
  using Words = __m256i;
  using Vector = __m256;

  static Words load_words(const std::uint32_t* from) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
  }
  static void store(float* to, Vector vector) { _mm256_store_ps(to, vector); }
  static void widen(const std::uint16_t* halves, float* steps, int count) {
    for (int k = 0; k < count; k += 8)
      store(steps + k, _mm256_cvtph_ps(_mm_load_si128(reinterpret_cast<const __m128i*>(halves + k))));
  }

  template <int bits>
  static Vector steps(float step) {
    return _mm256_set1_ps(step);
  }
  template <int bits, int shift>
  static Vector decode(Words words, Vector steps) {
    const Words codes = _mm256_and_si256(_mm256_srli_epi32(words, shift), _mm256_set1_epi32((1 << bits) - 1));
    return _mm256_mul_ps(_mm256_cvtepi32_ps(codes), steps);
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/tile_decoders.inl"

namespace radiosity {

TileDecoder avx2_tile_decoder(int bits, int block) {
  return decoder(bits, block);
}

}  // namespace radiosity
#endif
