#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/aligned_memory.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/texture_products.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiosity {
namespace {

/// Groups of columns whose products with a row are added up in float before they go to double.
constexpr int groups_of_a_run = 16;

/// Rows of blocks whose products with a column are added up in float.
constexpr Index block_rows_of_a_run = 64;

/// A power of two that brings the largest number of a column near 2^16; 1 where it is 0 or not finite.
double scale_of(const ConstFieldRef& column) {
  double largest = 0;
  for (Index i = 0; i < column.rows(); ++i) largest = std::max(largest, std::fabs(column(i, 0)));
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  const int exponent = std::clamp(15 - std::ilogb(largest), -1000, 1000);
  return std::ldexp(1.0, exponent);
}

/// One light: as many columns as the texture has matrices, in float.
class ScaledLight {
 public:
  ScaledLight(const ConstFieldRef& X, Index first_column, Index channels) {
    for (Index c = 0; c < channels; ++c) scales_.push_back(scale_of(X.col(first_column + c)));
  }
  float operator()(double x, Index channel) const {
    return static_cast<float>(x * scales_[static_cast<std::size_t>(channel)]);
  }
  /// What sums of a channel are to be multiplied by.
  double inverse(Index channel) const { return 1 / scales_[static_cast<std::size_t>(channel)]; }

 private:
  std::vector<double> scales_;
};

/// Rows of blocks that a LinearStrip has.
constexpr Index rows_of_strip = 16;

class TextureProduct {
 public:
  TextureProduct(const ColourTexture& M, const ConstFieldRef& X, FieldRef Y, InstructionSet instructions)
      : M_(M),
        X_(X),
        Y_(Y),
        channels_(M.channels()),
        groups_(M.block_columns() / ColourTexture::blocks_together),
        products_(texture_products(instructions)),
        linear_(!M.curve().logarithmic && products_.linear_strip[0] != nullptr) {}

  void multiply_light(Index first_column) {
    const ScaledLight light(X_, first_column, channels_);
    if (linear_) return multiply_linear_light(light, first_column);
    const AlignedBuffer<float> x(static_cast<std::size_t>(groups_ * channels_ * texture_group));
    parallel_for(static_cast<std::size_t>(groups_), [&](std::size_t group) {
      float* to = x.data() + static_cast<Index>(group) * channels_ * texture_group;
      for (Index c = 0; c < channels_; ++c)
        for (int place = 0; place < texture_group; ++place) {
          const Index column = static_cast<Index>(group) * texture_group + texture_group_column(place);
          to[c * texture_group + place] =
              column < M_.columns() ? light(X_(column, first_column + c), c) : 0.0F;
        }
    });
    constexpr std::size_t grain = 4;
    parallel_for(
        static_cast<std::size_t>(M_.block_rows()),
        [&](std::size_t row) { multiply_block_row(static_cast<Index>(row), x.data(), light, first_column); },
        grain);
  }

  void multiply_light_transposed(Index first_column) {
    const ScaledLight light(X_, first_column, channels_);
    const Index runs = (M_.block_rows() + block_rows_of_a_run - 1) / block_rows_of_a_run;
    const Index chunks = std::min<Index>(runs, 16);
    const std::size_t numbers = static_cast<std::size_t>(groups_ * channels_ * texture_group);
    std::vector<std::vector<double>> sums(static_cast<std::size_t>(chunks));
    parallel_for(static_cast<std::size_t>(chunks), [&](std::size_t index) {
      const auto chunk = static_cast<Index>(index);
      sums[index].assign(numbers, 0);
      for (Index run = runs * chunk / chunks; run < runs * (chunk + 1) / chunks; ++run)
        add_run(run, light, first_column, sums[index]);
    });
    parallel_for(static_cast<std::size_t>(groups_), [&](std::size_t group) {
      for (Index c = 0; c < channels_; ++c)
        for (int place = 0; place < texture_group; ++place) {
          const Index column = static_cast<Index>(group) * texture_group + texture_group_column(place);
          if (column >= M_.columns()) continue;
          const auto at = group * static_cast<std::size_t>(channels_ * texture_group) +
                          static_cast<std::size_t>(c * texture_group + place);
          double sum = 0;
          for (const std::vector<double>& own : sums) sum += own[at];
          Y_(column, first_column + c) = M_.scale(static_cast<int>(c)) * light.inverse(c) * sum;
        }
    });
  }

 private:
  TextureTask task_of(Index block_row, Index first_group, Index last_group) const {
    TextureTask task;
    task.blocks = reinterpret_cast<const std::uint64_t*>(M_.block_row(block_row) +
                                                         first_group * ColourTexture::blocks_together);
    task.groups = static_cast<int>(last_group - first_group);
    task.tables = M_.tables();
    task.logarithmic = M_.curve().logarithmic;
    return task;
  }

  void multiply_block_row(Index row, const float* x, const ScaledLight& light, Index first_column) {
    double sums[12] = {};
    for (Index group = 0; group < groups_; group += groups_of_a_run) {
      TextureTask task = task_of(row, group, std::min<Index>(group + groups_of_a_run, groups_));
      task.x = x + group * channels_ * texture_group;
      task.y_rows = sums;
      products_.to_rows[channels_ == 3](task);
    }
    const Index first = row * ColourTexture::block_side;
    for (Index c = 0; c < channels_; ++c)
      for (Index r = 0; r < std::min(ColourTexture::block_side, M_.rows() - first); ++r)
        Y_(first + r, first_column + c) = M_.scale(static_cast<int>(c)) * light.inverse(c) * sums[4 * c + r];
  }

  void multiply_linear_light(const ScaledLight& light, Index first_column) {
    const AlignedBuffer<float> weighted(
        static_cast<std::size_t>(M_.block_columns() * channels_ * linear_numbers));
    parallel_for(static_cast<std::size_t>(M_.block_columns()), [&](std::size_t column) {
      float* to = weighted.data() + static_cast<Index>(column) * channels_ * linear_numbers;
      for (Index c = 0; c < channels_; ++c)
        weigh_column(static_cast<Index>(column), c, light, first_column, to + c * linear_numbers);
    });
    const Index strips = (M_.block_rows() + rows_of_strip - 1) / rows_of_strip;
    parallel_for(static_cast<std::size_t>(strips), [&](std::size_t strip) {
      multiply_linear_strip(static_cast<Index>(strip) * rows_of_strip, weighted.data(), light, first_column);
    });
  }

  /// What LinearStrip::weighted is of a column of blocks.
  void weigh_column(Index block_column, Index channel, const ScaledLight& light, Index first_column,
                    float* to) const {
    constexpr float weights[4] = {0, 1, texture_third, 1 - texture_third};
    float x[4] = {};
    for (Index k = 0; k < 4; ++k)
      if (const Index column = 4 * block_column + k; column < M_.columns())
        x[k] = light(X_(column, first_column + channel), channel);
    for (int high = 0; high < 4; ++high)
      for (int low = 0; low < 4; ++low) {
        to[4 * high + low] = weights[low] * x[0] + weights[high] * x[1];
        to[16 + 4 * high + low] = weights[low] * x[2] + weights[high] * x[3];
      }
    to[32] = (x[0] + x[1]) + (x[2] + x[3]);
  }

  /// A copy with black rows below where rows of blocks are missing, else nothing.
  std::vector<Bc1Block> whole_strip(Index first_block_row, Index block_rows) const {
    if (block_rows == rows_of_strip) return {};
    std::vector<Bc1Block> blocks(static_cast<std::size_t>(rows_of_strip * M_.block_row_stride()));
    std::copy_n(M_.block_row(first_block_row), block_rows * M_.block_row_stride(), blocks.begin());
    return blocks;
  }

  void multiply_linear_strip(Index first_block_row, const float* weighted, const ScaledLight& light,
                             Index first_column) {
    const Index block_rows = std::min(rows_of_strip, M_.block_rows() - first_block_row);
    double sums[3 * 64] = {};
    const std::vector<Bc1Block> whole = whole_strip(first_block_row, block_rows);
    LinearStrip strip;
    strip.blocks =
        reinterpret_cast<const std::uint64_t*>(whole.empty() ? M_.block_row(first_block_row) : whole.data());
    strip.row_stride = M_.block_row_stride();
    strip.block_columns = static_cast<int>(M_.block_columns());
    strip.weighted = weighted;
    strip.y = sums;
    products_.linear_strip[channels_ == 3](strip);
    for (Index c = 0; c < channels_; ++c)
      for (Index b = 0; b < block_rows; ++b)
        for (Index r = 0; r < std::min<Index>(4, M_.rows() - 4 * (first_block_row + b)); ++r)
          Y_(4 * (first_block_row + b) + r, first_column + c) =
              M_.scale(static_cast<int>(c)) * light.inverse(c) * sums[64 * c + 16 * r + b];
  }

  /// Adds what some rows of blocks contribute to M' x.
  void add_run(Index run, const ScaledLight& light, Index first_column, std::vector<double>& sums) const {
    const AlignedBuffer<float> own(sums.size());
    std::fill(own.data(), own.data() + sums.size(), 0.0F);
    const Index last = std::min((run + 1) * block_rows_of_a_run, M_.block_rows());
    for (Index row = run * block_rows_of_a_run; row < last; ++row) {
      float x[12] = {};
      for (Index c = 0; c < channels_; ++c)
        for (Index r = 0; r < std::min(ColourTexture::block_side, M_.rows() - 4 * row); ++r)
          x[4 * c + r] = light(X_(4 * row + r, first_column + c), c);
      TextureTask task = task_of(row, 0, groups_);
      task.x_rows = x;
      task.y = own.data();
      products_.to_columns[channels_ == 3](task);
    }
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += static_cast<double>(own.data()[k]);
  }

  const ColourTexture& M_;
  const ConstFieldRef& X_;
  FieldRef Y_;
  Index channels_;
  Index groups_;
  TextureProducts products_;
  bool linear_;  ///< whether linear_strip multiplies
};

void require_whole_lights(const ColourTexture& M, const ConstFieldRef& X) {
  if (X.cols() % M.channels() != 0)
    fail<UsageError>("{} columns are no multiple of the {} matrices of the texture", X.cols(), M.channels());
}

}  // namespace

TextureProducts texture_products(InstructionSet instructions) {
  TextureProducts products;
#if defined(RADIOSITY_X86_KERNELS)
  if (instructions == InstructionSet::avx512) {
    get_avx512_texture_products(products);
    return products;
  }
  if (instructions == InstructionSet::avx2) {
    get_avx2_texture_products(products);
    return products;
  }
#endif
  static_cast<void>(instructions);
  get_baseline_texture_products(products);
  return products;
}

void multiply(const ColourTexture& M, const ConstFieldRef& X, FieldRef Y, InstructionSet instructions) {
  check_product_shapes(M.rows(), M.columns(), X, Y);
  require_whole_lights(M, X);
  TextureProduct product(M, X, Y, instructions);
  for (Index first = 0; first < X.cols(); first += M.channels()) product.multiply_light(first);
}

void multiply_transposed(const ColourTexture& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  check_product_shapes(M.columns(), M.rows(), X, Y);
  require_whole_lights(M, X);
  TextureProduct product(M, X, Y, instructions);
  for (Index first = 0; first < X.cols(); first += M.channels()) product.multiply_light_transposed(first);
}

}  // namespace radiosity
