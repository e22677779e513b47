#pragma once

#include <array>
#include <cstdint>

namespace radiosity {

/// Sixteen colours, 4 x 4 texels, in eight bytes: BC1, also called DXT1. Two colours of 5, 6 and 5 bits (red
/// in the highest bits) and, for each texel by rows, two bits from the lowest on, which choose one of
///
///   first > second:  first, second, (2 first + second) / 3, (first + 2 second) / 3
///   else:            first, second, (first + second) / 2, black.
///
/// Between the two colours this library computes in real numbers, as the format's specification has it;
/// hardware rounds.
struct Bc1Block {
  std::uint16_t first = 0;
  std::uint16_t second = 0;
  std::uint32_t indices = 0;

  bool operator==(const Bc1Block&) const = default;
};

/// The largest number of a channel (0 red, 1 green, 2 blue) of a BC1 colour: 31, 63, 31.
constexpr int bc1_largest(int channel) {
  return channel == 1 ? 63 : 31;
}
constexpr int bc1_shift(int channel) {
  return channel == 0 ? 11 : channel == 1 ? 5 : 0;
}
/// A channel of a BC1 colour as a whole number.
constexpr int bc1_channel(std::uint16_t colour, int channel) {
  return (colour >> bc1_shift(channel)) & bc1_largest(channel);
}

/// Sixteen numbers, 4 x 4 texels, in eight bytes: BC4. Two numbers of 8 bits and three bits a texel, from the
/// lowest bit of the first byte on, which choose one of
///
///   first > second:  first, second, (6 first + second) / 7, (5 first + 2 second) / 7 ... (first + 6
///   second)/7 else:            first, second, (4 first + second) / 5 ... (first + 4 second) / 5, 0, 255.
struct Bc4Block {
  std::uint8_t first = 0;
  std::uint8_t second = 0;
  std::array<std::uint8_t, 6> indices{};

  bool operator==(const Bc4Block&) const = default;
};

static_assert(sizeof(Bc1Block) == 8 && sizeof(Bc4Block) == 8);

/// The four colours of a block in [0, 255], by channel; the plain reference.
using Bc1Palette = std::array<std::array<double, 3>, 4>;
Bc1Palette bc1_palette(const Bc1Block& block);
/// The eight numbers of a block in [0, 255].
std::array<double, 8> bc4_palette(const Bc4Block& block);

/// Which of them texel t = 4 row + column has.
constexpr int bc1_index(const Bc1Block& block, int texel) {
  return static_cast<int>(block.indices >> (2 * texel)) & 3;
}
int bc4_index(const Bc4Block& block, int texel);
void set_bc4_index(Bc4Block& block, int texel, int index);

}  // namespace radiosity
