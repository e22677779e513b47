#include "compression/bc1_codec.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

constexpr std::size_t bc1_channels = 3;
constexpr float bc1_full_code = 255;
constexpr float bc1_intervals = 3;  // between the four colours of a block
constexpr std::array<int, bc1_channels> largest_end = {bc1_largest(0), bc1_largest(1), bc1_largest(2)};
constexpr std::array<float, bc1_channels> bc1_step = {bc1_full_code / 31, bc1_full_code / 63,
                                                      bc1_full_code / 31};

using Colour = std::array<float, bc1_channels>;
/// The channels of a block's two ends.
using Bc1Ends = std::array<std::array<int, 2>, bc1_channels>;

/// The texels' places on the line between two ends, 0 to 3.
struct Bc1Levels {
  Bc1Ends ends{};
  Texels level = Texels::Zero();
  float error = std::numeric_limits<float>::infinity();
};

/// Codes out of range would carry into the bits of other channels.
void require_codes(const Bc1Texels& texels) {
  Texels outside = texels.weight - texels.weight.abs();
  for (const Texels& code : texels.code) outside += (code - code.max(0).min(bc1_full_code)).abs();
  if (!(outside.sum() == 0)) fail<UsageError>("a BC1 block takes codes in [0, 255] with weights from 0 on");
}

/// Sums that every fit of one block needs.
struct Bc1Totals {
  float weight = 0;
  Colour code{};  ///< weighted

  explicit Bc1Totals(const Bc1Texels& texels) : weight(texels.weight.sum()) {
    for (std::size_t c = 0; c < bc1_channels; ++c) code[c] = (texels.weight * texels.code[c]).sum();
  }
};

/// The line through the mean along which the texels spread most.
struct PrincipalAxis {
  Texels along = Texels::Zero();  ///< coordinates on it, in units of its direction's length
  float deviation = 0;            ///< their root mean square
};

PrincipalAxis principal_axis(const Bc1Texels& texels, const Bc1Totals& total) {
  std::array<Texels, bc1_channels> centred;
  for (std::size_t c = 0; c < bc1_channels; ++c) centred[c] = texels.code[c] - total.code[c] / total.weight;
  std::array<Colour, bc1_channels> covariance{};
  for (std::size_t c = 0; c < bc1_channels; ++c) {
    const Texels weighted = texels.weight * centred[c];
    for (std::size_t d = c; d < bc1_channels; ++d)
      covariance[c][d] = covariance[d][c] = (weighted * centred[d]).sum();
  }
  // The power method from the column of the channel that spreads most, which is not orthogonal to the axis
  // unless the axis has none of that channel.
  std::size_t widest = 0;
  for (std::size_t c = 1; c < bc1_channels; ++c)
    if (covariance[c][c] > covariance[widest][widest]) widest = c;
  Colour axis = covariance[widest];
  constexpr int steps = 6;
  for (int step = 0; step < steps; ++step) {
    const float size = std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
    if (!(size > std::numeric_limits<float>::min())) return {};
    Colour next{};
    for (std::size_t c = 0; c < bc1_channels; ++c)
      for (std::size_t d = 0; d < bc1_channels; ++d) next[c] += covariance[c][d] * (axis[d] / size);
    axis = next;
  }
  const float length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  if (!(length > 0)) return {};
  PrincipalAxis result;
  for (std::size_t c = 0; c < bc1_channels; ++c) result.along += centred[c] * (axis[c] / length);
  result.deviation = std::sqrt((texels.weight * result.along.square()).sum() / total.weight);
  return result;
}

/// Each texel to the nearest of the four colours, which lie on a line at equal distances.
Bc1Levels nearest_levels(const Bc1Texels& texels, const Bc1Ends& ends) {
  Colour first{}, direction{};
  float squared = 0;
  for (std::size_t c = 0; c < bc1_channels; ++c) {
    first[c] = bc1_step[c] * static_cast<float>(ends[c][0]);
    direction[c] = bc1_step[c] * static_cast<float>(ends[c][1] - ends[c][0]);
    squared += direction[c] * direction[c];
  }
  Bc1Levels result;
  result.ends = ends;
  if (squared > 0) {
    Texels along = Texels::Constant(0.5F);
    for (std::size_t c = 0; c < bc1_channels; ++c)
      along += (texels.code[c] - first[c]) * (bc1_intervals * direction[c] / squared);
    result.level = along.max(0).min(bc1_intervals).floor();
  }
  Texels error = Texels::Zero();
  for (std::size_t c = 0; c < bc1_channels; ++c)
    error += (texels.code[c] - first[c] - result.level * (direction[c] / bc1_intervals)).square();
  result.error = (texels.weight * error).sum();
  return result;
}

Bc1Ends outermost(const Bc1Texels& texels, const PrincipalAxis& axis) {
  Eigen::Index least = -1, most = -1;
  for (Eigen::Index t = 0; t < Texels::SizeAtCompileTime; ++t) {
    if (!(texels.weight[t] > 0)) continue;
    if (least < 0 || axis.along[t] < axis.along[least]) least = t;
    if (most < 0 || axis.along[t] > axis.along[most]) most = t;
  }
  Bc1Ends ends{};
  for (std::size_t c = 0; c < bc1_channels; ++c)
    ends[c] = {nearest_whole(texels.code[c][least] / bc1_step[c]),
               nearest_whole(texels.code[c][most] / bc1_step[c])};
  return ends;
}

/// Ends for the levels, levels for the ends, and so on while it helps.
Bc1Levels alternated(const Bc1Texels& texels, const Bc1Totals& total, Bc1Levels from) {
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    const Texels share = from.level * (1 / bc1_intervals);
    const LevelFit fit(total.weight, texels.weight * share, share);
    Bc1Ends ends{};
    for (std::size_t c = 0; c < bc1_channels; ++c)
      ends[c] = fit.ends(texels.code[c], total.code[c], bc1_step[c], largest_end[c]);
    const Bc1Levels next = nearest_levels(texels, ends);
    if (!(next.error < from.error)) break;
    from = next;
  }
  return from;
}

Bc1Levels clustered(const Bc1Texels& texels, const Bc1Totals& total, const PrincipalAxis& axis,
                    const Bc1Levels& range) {
  Bc1Levels best = alternated(texels, total, range);
  const auto try_levels = [&](const Texels& level) {
    Bc1Levels start;
    start.level = level;
    const Bc1Levels result = alternated(texels, total, start);
    if (result.error < best.error) best = result;
  };
  // Constants are met to a third of a step between ends that differ by one.
  try_levels(Texels::Ones());
  if (!(axis.deviation > 0)) return best;
  // A spread of so many deviations on either side of the mean, from two clusters to a uniform one and more.
  for (const float reach : {1.0F, 1.5F}) {
    const float scale = bc1_intervals / 2 / (reach * axis.deviation);
    try_levels((axis.along * scale + (bc1_intervals / 2 + 0.5F)).max(0).min(bc1_intervals).floor());
  }
  return best;
}

std::uint16_t colour_of(const Bc1Ends& ends, std::size_t which) {
  int colour = 0;
  for (std::size_t c = 0; c < bc1_channels; ++c) colour |= ends[c][which] << bc1_shift(static_cast<int>(c));
  return static_cast<std::uint16_t>(colour);
}

Bc1Block block_of(const Bc1Levels& levels) {
  Bc1Block block{colour_of(levels.ends, 0), colour_of(levels.ends, 1), 0};
  if (block.first == block.second) return block;
  constexpr std::array<std::uint32_t, 4> index_of_level = {0, 2, 3, 1};
  for (int t = 0; t < Texels::SizeAtCompileTime; ++t)
    block.indices |= index_of_level[static_cast<std::size_t>(levels.level[t])] << (2 * t);
  if (block.first < block.second) {
    std::swap(block.first, block.second);
    block.indices ^= 0x55555555U;  // 0 and 1, 2 and 3 change places
  }
  return block;
}

}  // namespace

Bc1Block encode_bc1(const Bc1Texels& texels, Bc1Fit fit) {
  require_codes(texels);
  const Bc1Totals total(texels);
  if (!(total.weight > 0)) return {};
  const PrincipalAxis axis = principal_axis(texels, total);
  const Bc1Levels range = nearest_levels(texels, outermost(texels, axis));
  const Bc1Block block = block_of(range);
  if (fit == Bc1Fit::range || range.error == 0) return block;
  const Bc1Block better = block_of(clustered(texels, total, axis, range));
  return squared_error(texels, better) < squared_error(texels, block) ? better : block;
}

double squared_error(const Bc1Texels& texels, const Bc1Block& block) {
  const Bc1Palette palette = bc1_palette(block);
  double sum = 0;
  for (int t = 0; t < Texels::SizeAtCompileTime; ++t) {
    const auto& colour = palette[static_cast<std::size_t>(bc1_index(block, t))];
    double squared = 0;
    for (std::size_t c = 0; c < bc1_channels; ++c) {
      const double error = static_cast<double>(texels.code[c][t]) - colour[c];
      squared += error * error;
    }
    sum += static_cast<double>(texels.weight[t]) * squared;
  }
  return sum;
}

}  // namespace radiosity
