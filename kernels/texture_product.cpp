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

class TextureProduct {
 public:
  TextureProduct(const ColourTexture& M, const ConstFieldRef& X, FieldRef Y, InstructionSet instructions)
      : M_(M),
        X_(X),
        Y_(Y),
        channels_(M.channels()),
        groups_(M.block_columns() / ColourTexture::blocks_together),
        products_(texture_products(instructions)),
        linear_(!M.curve().logarithmic && products_.linear_to_rows[0] != nullptr) {}

  void multiply_light(Index first_column) {
    const ScaledLight light(X_, first_column, channels_);
    const AlignedBuffer<float> x(static_cast<std::size_t>(groups_ * channels_ * texture_group));
    parallel_for(static_cast<std::size_t>(groups_), [&](std::size_t group) {
      float* to = x.data() + static_cast<Index>(group) * channels_ * texture_group;
      for (Index c = 0; c < channels_; ++c)
        for (int place = 0; place < texture_group; ++place) {
          const Index column = static_cast<Index>(group) * texture_group +
                               (linear_ ? linear_group_column(place) : texture_group_column(place));
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
      (linear_ ? products_.linear_to_rows : products_.to_rows)[channels_ == 3](task);
    }
    const Index first = row * ColourTexture::block_side;
    for (Index c = 0; c < channels_; ++c)
      for (Index r = 0; r < std::min(ColourTexture::block_side, M_.rows() - first); ++r)
        Y_(first + r, first_column + c) = M_.scale(static_cast<int>(c)) * light.inverse(c) * sums[4 * c + r];
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
  bool linear_;  ///< whether linear_to_rows multiplies
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
