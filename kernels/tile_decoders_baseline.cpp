#include "kernels/tile_decoders.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

namespace radiosity {
namespace {

// Vectors of 16 bytes in the language extension that GCC and Clang share: whatever every processor of the
// target has.
struct Codes {
  static constexpr int width = 4;
  typedef std::int32_t Words __attribute__((vector_size(16)));
  typedef std::uint32_t Unsigned __attribute__((vector_size(16)));
  typedef float Vector __attribute__((vector_size(16)));

  static Words load_words(const std::uint32_t* from) {
    Words words;
    std::memcpy(&words, from, sizeof words);
    return words;
  }
  static void store(float* to, Vector vector) { std::memcpy(to, &vector, sizeof vector); }

  /// to_float without its branch: steps are neither infinite nor NaN, and not negative.
  static void widen(const std::uint16_t* halves, float* steps, int count) {
    for (int k = 0; k < count; ++k) {
      const std::uint32_t bits = static_cast<std::uint32_t>(halves[k]) << 13;
      float scaled;
      std::memcpy(&scaled, &bits, sizeof scaled);
      steps[k] = scaled * 0x1p112F;
    }
  }

  template <int bits>
  static Vector steps(float step) {
    return Vector{} + step;
  }
  template <int bits, int shift>
  static Vector decode(Words words, Vector steps) {
    const auto shifted = reinterpret_cast<Words>(reinterpret_cast<Unsigned>(words) >> shift);
    return __builtin_convertvector(shifted & ((1 << bits) - 1), Vector) * steps;
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/tile_decoders.inl"

namespace radiosity {

TileDecoder baseline_tile_decoder(int bits, int block) {
  return decoder(bits, block);
}

}  // namespace radiosity
