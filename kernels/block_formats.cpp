#include "kernels/block_formats.hpp"

namespace radiosity {
namespace {

constexpr double full_code = 255;

std::uint64_t bc4_bits(const Bc4Block& block) {
  std::uint64_t bits = 0;
  for (std::size_t byte = 0; byte < block.indices.size(); ++byte)
    bits |= std::uint64_t{block.indices[byte]} << (8 * byte);
  return bits;
}

}  // namespace

Bc1Palette bc1_palette(const Bc1Block& block) {
  Bc1Palette palette{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const int of = static_cast<int>(channel);
    const double first = full_code * bc1_channel(block.first, of) / bc1_largest(of);
    const double second = full_code * bc1_channel(block.second, of) / bc1_largest(of);
    palette[0][channel] = first;
    palette[1][channel] = second;
    if (block.first > block.second) {
      palette[2][channel] = (2 * first + second) / 3;
      palette[3][channel] = (first + 2 * second) / 3;
    } else {
      palette[2][channel] = (first + second) / 2;
    }
  }
  return palette;
}

std::array<double, 8> bc4_palette(const Bc4Block& block) {
  std::array<double, 8> palette{};
  palette[0] = block.first;
  palette[1] = block.second;
  const bool eight = block.first > block.second;
  const int parts = eight ? 7 : 5;
  for (int part = 1; part < parts; ++part)
    palette[static_cast<std::size_t>(part) + 1] =
        static_cast<double>((parts - part) * block.first + part * block.second) / parts;
  if (!eight) palette[7] = full_code;
  return palette;
}

int bc4_index(const Bc4Block& block, int texel) {
  return static_cast<int>(bc4_bits(block) >> (3 * texel)) & 7;
}

void set_bc4_index(Bc4Block& block, int texel, int index) {
  std::uint64_t bits = bc4_bits(block) & ~(std::uint64_t{7} << (3 * texel));
  bits |= static_cast<std::uint64_t>(index) << (3 * texel);
  for (std::size_t byte = 0; byte < block.indices.size(); ++byte)
    block.indices[byte] = static_cast<std::uint8_t>(bits >> (8 * byte));
}

}  // namespace radiosity
