#include "kernels/block_formats.hpp"
#include "kernels/texture_products.hpp"

namespace radiosity {
namespace {

/// The place of block b in a group's order, without its last two bits.
constexpr int quarter_of_block(int b) {
  return b % 4 * 16 + b / 4 * 4;
}

/// Four floats, plainly.
struct Texels {
  static constexpr int width = 4;
  struct Vector {
    float at[4];
  };
  struct Words {
    std::uint32_t at[4];
  };

  static Vector zero() { return {}; }
  static Vector broadcast(float number) { return {{number, number, number, number}}; }
  static Vector load(const float* from) { return {{from[0], from[1], from[2], from[3]}}; }
  static void store(float* to, Vector vector) {
    for (int i = 0; i < 4; ++i) to[i] = vector.at[i];
  }
  static Words load_words(const std::uint32_t* from) { return {{from[0], from[1], from[2], from[3]}}; }
  static Vector multiply_add(Vector a, Vector b, Vector c) {
    for (int i = 0; i < 4; ++i) c.at[i] += a.at[i] * b.at[i];
    return c;
  }
  static double sum(Vector vector) {
    return static_cast<double>((vector.at[0] + vector.at[2]) + (vector.at[1] + vector.at[3]));
  }

  template <int row>
  static Words indices(Words words) {
    for (int i = 0; i < 4; ++i) words.at[i] >>= 8 * row + 2 * i;
    return words;
  }
  static Vector select(Vector palette, Words indices) {
    Vector chosen;
    for (int i = 0; i < 4; ++i) chosen.at[i] = palette.at[indices.at[i] & 3U];
    return chosen;
  }

  static void spread_indices(const std::uint64_t* blocks, std::uint32_t* words) {
    for (int b = 0; b < 16; ++b)
      for (int i = 0; i < 4; ++i)
        words[quarter_of_block(b) + i] = static_cast<std::uint32_t>(blocks[b] >> 32);
  }

  template <int colour, bool logarithmic>
  static void palettes(const std::uint64_t* blocks, const float* table, float* numbers) {
    for (int b = 0; b < 16; ++b) {
      const int first = bc1_channel(static_cast<std::uint16_t>(blocks[b]), colour);
      const int second = bc1_channel(static_cast<std::uint16_t>(blocks[b] >> 16), colour);
      float* palette = numbers + quarter_of_block(b);
      const float A = table[first];
      const float B = table[second];
      if constexpr (logarithmic) {
        const float AA = A * A;
        const float BB = B * B;
        const bool black = first == 0 && second == 0;
        palette[0] = first == 0 ? 0 : AA * A;
        palette[1] = second == 0 ? 0 : BB * B;
        palette[2] = black ? 0 : AA * B;
        palette[3] = black ? 0 : A * BB;
      } else {
        const float A_third = A * texture_third;
        const float B_third = B * texture_third;
        palette[0] = A;
        palette[1] = B;
        palette[2] = (A_third + A_third) + B_third;
        palette[3] = A_third + (B_third + B_third);
      }
    }
  }
};

}  // namespace
}  // namespace radiosity

#include "kernels/texture_products.inl"

namespace radiosity {

void get_baseline_texture_products(TextureProducts& products) {
  get_texture_products(products);
}

}  // namespace radiosity
