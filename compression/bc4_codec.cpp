#include "compression/bc4_codec.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

constexpr int largest_code = 255;
/// Levels that mean the numbers 0 and 255 where a block has them beside the levels between its ends.
constexpr float level_of_zero = 6, level_of_full = 7;

/// Where the texels lie: 0 to `intervals` between the ends, or at 0 or 255.
struct Bc4Levels {
  std::array<int, 2> ends{};
  Texels level = Texels::Zero();
  float error = std::numeric_limits<float>::infinity();
};

void require_codes(const Bc4Texels& texels) {
  const Texels outside =
      (texels.code - texels.code.max(0).min(largest_code)).abs() + (texels.weight.abs() - texels.weight);
  if (!(outside.sum() == 0)) fail<UsageError>("a BC4 block takes codes in [0, 255] with weights from 0 on");
}

/// The two kinds of blocks: 7 intervals, or 5 and the numbers 0 and 255 beside them.
class Bc4Mode {
 public:
  Bc4Mode(const Bc4Texels& texels, int intervals, bool has_extremes)
      : texels_(texels), intervals_(static_cast<float>(intervals)), has_extremes_(has_extremes) {}

  Bc4Levels best() const {
    const Bc4Levels outermost = alternated(nearest(outermost_ends()));
    const Bc4Levels inner = alternated(nearest(inner_ends()));
    return descended(inner.error < outermost.error ? inner : outermost);
  }

 private:
  /// 1 for the texels between the ends at the beginning: what is 0 or 255 already needs no level there.
  Texels between() const {
    if (!has_extremes_) return Texels::Ones();
    constexpr float half_code = 0.5F;
    return ((texels_.code >= half_code) && (texels_.code <= largest_code - half_code)).cast<float>();
  }

  std::array<int, 2> outermost_ends() const {
    const auto counts = (texels_.weight * between() > 0).eval();
    if (!counts.any()) return {0, 0};
    return {nearest_whole(counts.select(texels_.code, largest_code).minCoeff()),
            nearest_whole(counts.select(texels_.code, 0).maxCoeff())};
  }

  /// So many standard deviations from the mean that noise fills what is between.
  std::array<int, 2> inner_ends() const {
    constexpr float reach = 1.5F;
    const Texels weight = texels_.weight * between();
    const float total = weight.sum();
    if (!(total > 0)) return {0, 0};
    const float mean = (weight * texels_.code).sum() / total;
    const float spread = reach * std::sqrt((weight * (texels_.code - mean).square()).sum() / total);
    return {static_cast<int>(std::max(0.0F, mean - spread)),
            static_cast<int>(std::min(static_cast<float>(largest_code), mean + spread + 1))};
  }

  Bc4Levels nearest(const std::array<int, 2>& ends) const {
    const auto first = static_cast<float>(ends[0]), span = static_cast<float>(ends[1] - ends[0]);
    const Texels& code = texels_.code;
    Bc4Levels result{ends};
    if (span != 0)
      result.level = ((code - first) * (intervals_ / span) + 0.5F).max(0).min(intervals_).floor();
    Texels error = (code - first - result.level * (span / intervals_)).square();
    if (has_extremes_) {
      const Texels of_zero = code.square(), of_full = (code - largest_code).square();
      result.level = (of_zero < error).select(level_of_zero, result.level);
      error = error.min(of_zero);
      result.level = (of_full < error).select(level_of_full, result.level);
      error = error.min(of_full);
    }
    result.error = (texels_.weight * error).sum();
    return result;
  }

  /// Ends for the levels, levels for the ends, and so on while it helps.
  Bc4Levels alternated(Bc4Levels from) const {
    constexpr int most_rounds = 4;
    for (int round = 0; round < most_rounds && from.error > 0; ++round) {
      const Texels weight = (from.level <= intervals_).select(texels_.weight, 0);
      const float total = weight.sum();
      if (!(total > 0)) break;
      const Texels share = from.level * (1 / intervals_);
      const LevelFit fit(total, weight * share, share);
      const Bc4Levels next = nearest(fit.ends(texels_.code, (weight * texels_.code).sum(), 1, largest_code));
      if (!(next.error < from.error)) break;
      from = next;
    }
    return from;
  }

  /// Ends that neighbour those found, while one of them is better.
  Bc4Levels descended(Bc4Levels from) const {
    constexpr std::array<std::array<int, 2>, 8> moves = {
        {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, 1}, {1, -1}, {-1, -1}, {1, 1}}};
    constexpr int most_steps = 32;
    std::size_t failed = 0;
    for (int step = 0; step < most_steps && failed < moves.size() && from.error > 0; ++step) {
      const auto& [of_first, of_second] = moves[static_cast<std::size_t>(step) % moves.size()];
      const Bc4Levels next = nearest({std::clamp(from.ends[0] + of_first, 0, largest_code),
                                      std::clamp(from.ends[1] + of_second, 0, largest_code)});
      failed = next.error < from.error ? 0 : failed + 1;
      if (failed == 0) from = next;
    }
    return from;
  }

  const Bc4Texels& texels_;
  float intervals_;
  bool has_extremes_;
};

Bc4Block packed(int first, int second, const Texels& level, int intervals) {
  Bc4Block block{static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second), {}};
  std::uint64_t bits = 0;
  for (int t = 0; t < Texels::SizeAtCompileTime; ++t) {
    const int at = static_cast<int>(level[t]);
    const int index = at == 0 ? 0 : at == intervals ? 1 : at < intervals ? at + 1 : at;
    bits |= static_cast<std::uint64_t>(index) << (3 * t);
  }
  for (std::size_t byte = 0; byte < block.indices.size(); ++byte)
    block.indices[byte] = static_cast<std::uint8_t>(bits >> (8 * byte));
  return block;
}

/// The order of the ends says which mode a block has: the first is larger in one of eight levels.
Bc4Block block_of_eight(const Bc4Levels& levels) {
  constexpr int intervals = 7;
  const auto [first, second] = levels.ends;
  if (first == second) return packed(first, second, Texels::Zero(), intervals);
  return first > second ? packed(first, second, levels.level, intervals)
                        : packed(second, first, intervals - levels.level, intervals);
}

Bc4Block block_of_six(const Bc4Levels& levels) {
  constexpr int intervals = 5;
  const auto [first, second] = levels.ends;
  if (first <= second) return packed(first, second, levels.level, intervals);
  const Texels turned = (levels.level <= intervals).select(intervals - levels.level, levels.level);
  return packed(second, first, turned, intervals);
}

}  // namespace

Bc4Block encode_bc4(const Bc4Texels& texels) {
  require_codes(texels);
  if (!(texels.weight.sum() > 0)) return {};
  const Bc4Levels eight = Bc4Mode(texels, 7, false).best();
  const Bc4Block block = block_of_eight(eight);
  if (eight.error == 0) return block;
  const Bc4Block with_extremes = block_of_six(Bc4Mode(texels, 5, true).best());
  return squared_error(texels, with_extremes) < squared_error(texels, block) ? with_extremes : block;
}

double squared_error(const Bc4Texels& texels, const Bc4Block& block) {
  const std::array<double, 8> palette = bc4_palette(block);
  double sum = 0;
  for (int t = 0; t < Texels::SizeAtCompileTime; ++t) {
    const double error =
        static_cast<double>(texels.code[t]) - palette[static_cast<std::size_t>(bc4_index(block, t))];
    sum += static_cast<double>(texels.weight[t]) * error * error;
  }
  return sum;
}

}  // namespace radiosity
