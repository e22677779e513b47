#include "kernels/tile_format.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

constexpr std::int64_t entries_in_tile = 64 * 64;
constexpr double bits_of_one = 0x3f800000;
constexpr double bits_of_octave = 0x800000;
constexpr double top_of_codes = 255;

}  // namespace

TileCurve TileCurve::logarithm(double range) {
  if (!(range > 0 && range <= 80))
    fail<UsageError>("codes that span {} natural logarithms: take more than 0 and at most 80", range);
  const double bits = range / std::numbers::ln2 * bits_of_octave;
  return {true, static_cast<float>(bits_of_one - bits), static_cast<float>(bits / top_of_codes)};
}

float TileCurve::number(float code) const {
  const float scaled = code * slope;
  if (!logarithmic) return scaled;
  return code > 0 ? std::bit_cast<float>(static_cast<std::int32_t>(scaled + base)) : 0.0F;
}

namespace {

std::array<float, 8> linear_bc4_numbers(const Bc4Block& block, float slope) {
  const bool eight = block.first > block.second;
  const float A = static_cast<float>(block.first) * slope;
  const float B = static_cast<float>(block.second) * slope;
  const float step = (B - A) * (eight ? bc4_seventh : bc4_fifth);
  std::array<float, 8> numbers = {A, B};
  for (std::size_t k = 1; k < (eight ? 7U : 5U); ++k) numbers[k + 1] = A + static_cast<float>(k) * step;
  if (!eight) numbers[7] = static_cast<float>(top_of_codes) * slope;
  return numbers;
}

std::array<float, 8> logarithmic_bc4_numbers(const Bc4Block& block, const TileCurve& curve) {
  const bool eight = block.first > block.second;
  const auto bits = [&](int code) {
    return static_cast<std::int32_t>(static_cast<float>(code) * curve.slope + curve.base);
  };
  const std::int32_t A = bits(block.first);
  const std::int32_t B = bits(block.second);
  const auto step = static_cast<std::int32_t>(static_cast<float>(B - A) * (eight ? bc4_seventh : bc4_fifth));
  std::array<float, 8> numbers{};
  if (block.first > 0) numbers[0] = std::bit_cast<float>(A);
  if (block.second > 0) numbers[1] = std::bit_cast<float>(B);
  if (block.first > 0 || block.second > 0)
    for (std::int32_t k = 1; k < (eight ? 7 : 5); ++k)
      numbers[static_cast<std::size_t>(k) + 1] = std::bit_cast<float>(A + k * step);
  if (!eight) numbers[7] = std::bit_cast<float>(bits(static_cast<int>(top_of_codes)));
  return numbers;
}

}  // namespace

std::array<float, 8> bc4_numbers(const Bc4Block& block, const TileCurve& curve) {
  return curve.logarithmic ? logarithmic_bc4_numbers(block, curve) : linear_bc4_numbers(block, curve.slope);
}

double TileCurve::code(double part) const {
  if (!(part > 0)) return 0;
  const double code =
      logarithmic ? (std::bit_cast<std::int32_t>(static_cast<float>(part)) - static_cast<double>(base)) /
                        static_cast<double>(slope)
                  : part / static_cast<double>(slope);
  return std::clamp(code, 0.0, top_of_codes);
}

std::int64_t TileFormat::record_bytes() const {
  switch (code) {
    case EntryCode::steps:
      if (bits != 0 && bits != 2 && bits != 4 && bits != 8)
        fail<UsageError>("codes of {} bits: there are 2, 4 and 8", bits);
      if (block != 16 && block != 32 && block != 64)
        fail<UsageError>("blocks of {} entries: there are 16, 32 and 64", block);
      return bits == 0 ? 0 : 2 * entries_in_tile / block + entries_in_tile * bits / 8;
    case EntryCode::curve:
      if (bits != 4 && bits != 8) fail<UsageError>("codes of {} bits on a curve: there are 4 and 8", bits);
      return entries_in_tile * bits / 8;
    case EntryCode::bc4:
      return entries_in_tile / 2;
    case EntryCode::half:
    case EntryCode::brain:
      break;
  }
  return 2 * entries_in_tile;
}

}  // namespace radiosity
