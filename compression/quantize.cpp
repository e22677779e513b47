#include "compression/quantize.hpp"

#include "compression/half_kernel.hpp"
#include "compression/largest_scores.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

constexpr Index size = QuantizedTiles::tile_size;
constexpr Index entries_in_tile = QuantizedTiles::tile_entries;

/// What taking entries of a block apart saves: entry after entry, from the largest down, the decrease of
/// (entries left) (largest left)^2 along its upper convex hull.
class BlockSavings {
 public:
  /// Positions of the entries that are not zero, the largest first, and what each saves, which never rises.
  std::vector<std::pair<double, std::uint16_t>> entries;
  std::vector<float> savings;

  void look_at(const HalfKernel::Tile& tile, std::size_t first, std::size_t count) {
    entries.clear();
    for (std::size_t k = first; k < first + count; ++k)
      if (tile[k] > 0) entries.emplace_back(tile[k], static_cast<std::uint16_t>(k));
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    find_hull();
  }

 private:
  double left_after(std::size_t taken) const {
    const double largest = taken < entries.size() ? entries[taken].first : 0;
    return static_cast<double>(entries.size() - taken) * largest * largest;
  }

  void find_hull() {
    savings.assign(entries.size(), 0);
    hull_.assign(1, 0);
    for (std::size_t k = 1; k <= entries.size(); ++k) {
      while (hull_.size() > 1 && slope(hull_.back(), k) >= slope(hull_[hull_.size() - 2], hull_.back()))
        hull_.pop_back();
      hull_.push_back(k);
    }
    for (std::size_t h = 1; h < hull_.size(); ++h)
      for (std::size_t k = hull_[h - 1]; k < hull_[h]; ++k)
        savings[k] = static_cast<float>(std::max(0.0, slope(hull_[h - 1], hull_[h])));
  }

  double slope(std::size_t from, std::size_t to) const {
    return (left_after(from) - left_after(to)) / static_cast<double>(to - from);
  }

  std::vector<std::size_t> hull_;
};

/// Which entries of every tile are kept apart.
class ExactChoice {
 public:
  ExactChoice(const HalfKernel& kernel, const QuantizeOptions& options, double scale, std::size_t wanted)
      : block_(static_cast<std::size_t>(options.block)), cuts_(kernel.tile_count(), none) {
    if (wanted == 0) return;
    std::vector<std::vector<float>> savings(kernel.tile_count());
    parallel_for(savings.size(), [&](std::size_t number) {
      const HalfKernel::Tile tile = kernel.tile(number, scale);
      BlockSavings block;
      for (std::size_t first = 0; first < tile.size(); first += block_) {
        block.look_at(tile, first, block_);
        savings[number].insert(savings[number].end(), block.savings.begin(), block.savings.end());
      }
    });
    cuts_ = cut_to_largest(savings, wanted);
  }

  HalfKernel::Marks of_tile(const HalfKernel::Tile& tile, std::size_t number) const {
    HalfKernel::Marks exact;
    ScoreCut cut = cuts_[number];
    if (cut.above == none.above) return exact;
    BlockSavings block;
    for (std::size_t first = 0; first < tile.size(); first += block_) {
      block.look_at(tile, first, block_);
      for (std::size_t k = 0; k < block.entries.size(); ++k)
        if (cut.takes(block.savings[k])) exact.set(block.entries[k].second);
    }
    return exact;
  }

 private:
  static constexpr ScoreCut none = {std::numeric_limits<float>::infinity(), 0};
  std::size_t block_;
  std::vector<ScoreCut> cuts_;
};

/// Rounds one tile to codes.
class TileRounding {
 public:
  TileRounding(QuantizedTiles& result, std::size_t number, const HalfKernel::Tile& tile,
               const HalfKernel::Marks& exact)
      : result_(result), number_(static_cast<Index>(number)), tile_(tile), exact_(exact) {
    find_steps();
  }

  void round_alone() {
    for (Index r = 0; r < size; ++r)
      for (Index c = 0; c < size; ++c)
        if (has_code(r, c)) round(r, c, entry(r, c));
  }

  /// Weights of the tile's 64 rows and columns.
  void round_with_diffusion(const double* row_weights, const double* column_weights) {
    // Errors on their way, as energy: of this row and of the next one, with a place on either side.
    std::array<double, size + 2> here{};
    std::array<double, size + 2> below{};
    for (Index r = 0; r < size; ++r) {
      const bool back = r % 2 == 1;
      below.fill(0);
      for (Index k = 0; k < size; ++k) {
        const Index c = back ? size - 1 - k : k;
        const auto at = static_cast<std::size_t>(c + 1);
        double error = here[at];
        if (has_code(r, c)) {
          const double weight = row_weights[r] * column_weights[c];
          const double step = step_of(r, c);
          const double wanted = entry(r, c) + std::clamp(error / weight, -step, step);
          error = (wanted - round(r, c, wanted)) * weight;
        }
        const std::size_t ahead = back ? at - 1 : at + 1;
        const std::size_t behind = back ? at + 1 : at - 1;
        here[ahead] += error * (7.0 / 16);
        below[behind] += error * (3.0 / 16);
        below[at] += error * (5.0 / 16);
        below[ahead] += error * (1.0 / 16);
      }
      here = below;
    }
  }

 private:
  double entry(Index r, Index c) const { return tile_[static_cast<std::size_t>(r * size + c)]; }
  double step_of(Index r, Index c) const {
    return steps_[static_cast<std::size_t>((r * size + c) / result_.format().block)];
  }
  /// Zeros stay zero, whatever error arrives at them.
  bool has_code(Index r, Index c) const {
    return entry(r, c) > 0 && !exact_[static_cast<std::size_t>(r * size + c)];
  }

  void find_steps() {
    const Index block = result_.format().block;
    for (Index first = 0; first < entries_in_tile; first += block) {
      double largest = 0;
      for (Index k = first; k < first + block; ++k)
        if (!exact_[static_cast<std::size_t>(k)])
          largest = std::max(largest, tile_[static_cast<std::size_t>(k)]);
      const double wanted = largest / result_.largest_code();
      Half step = to_half(wanted);
      if (to_double(step) < wanted) ++step.bits;
      result_.set_step(number_, first / size, first % size / block, step);
      steps_[static_cast<std::size_t>(first / block)] = to_double(step);
    }
  }

  /// The number that the nearest code gives.
  double round(Index r, Index c, double wanted) {
    const double step = step_of(r, c);
    const double code =
        std::clamp(std::floor(wanted / step + 0.5), 0.0, static_cast<double>(result_.largest_code()));
    result_.set_code(number_, r, c, static_cast<unsigned>(code));
    return code * step;
  }

  QuantizedTiles& result_;
  Index number_;
  const HalfKernel::Tile& tile_;
  const HalfKernel::Marks& exact_;
  std::array<double, entries_in_tile / 16> steps_{};
};

/// Weights of the 64 patches of a tile row; 1 beyond the last patch.
std::array<double, size> weights_of(const Eigen::VectorXd& weight, Index tile_row) {
  std::array<double, size> weights;
  weights.fill(1);
  for (Index k = 0; k < std::min(size, weight.size() - tile_row * size); ++k)
    weights[static_cast<std::size_t>(k)] = weight[tile_row * size + k];
  return weights;
}

}  // namespace

QuantizedTiles quantize(const SymmetricTiles<double>& K, const Eigen::VectorXd& weight,
                        const QuantizeOptions& options) {
  if (weight.size() != K.size() || !(weight.array() > 0).all())
    fail<UsageError>("{} weights for a kernel of size {}: every patch needs a positive one", weight.size(),
                     K.size());
  if (options.bits == 0) fail<UsageError>("codes of 0 bits: there are 2, 4 and 8");
  QuantizedTiles result(K.directory(), options.bits, options.block);
  const HalfKernel kernel(K);
  const double scale = storage_scale<Half>(kernel.largest());
  result.set_scale(scale);
  const ExactChoice choice(kernel, options, scale, kernel.share_of_entries(options.exact));
  std::vector<QuantizedTiles::ExactEntries> exact(kernel.tile_count());
  parallel_for(kernel.tile_count(), [&](std::size_t number) {
    const HalfKernel::Tile tile = kernel.tile(number, scale);
    const HalfKernel::Marks kept_apart = choice.of_tile(tile, number);
    exact[number] = HalfKernel::marked_entries(tile, kept_apart);
    TileRounding rounding(result, number, tile, kept_apart);
    if (options.diffusion)
      rounding.round_with_diffusion(weights_of(weight, kernel.tile_row(number)).data(),
                                    weights_of(weight, kernel.tile_column(number)).data());
    else
      rounding.round_alone();
  });
  result.set_exact(exact);
  return result;
}

}  // namespace radiosity
