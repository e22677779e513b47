#include "kernels/colour_texture.hpp"

#include "foundation/error.hpp"
#include "kernels/texture_products.hpp"

#include <cmath>

namespace radiosity {
namespace {

void fill_tables(const TextureCurve& curve, float* tables) {
  for (int channel = 0; channel < 3; ++channel)
    for (int code = 0; code <= bc1_largest(channel); ++code) {
      const double part = static_cast<double>(code) / bc1_largest(channel);
      tables[channel * texture_table + code] =
          static_cast<float>(curve.logarithmic ? std::exp(curve.range * (part - 1) / 3) : part);
    }
}

/// Rows that are read together must not fall into the same few sets of a cache: a line more where they are a
/// multiple of 2 KiB.
Index stride_of(Index block_columns) {
  constexpr Index line = 64 / sizeof(Bc1Block);
  return block_columns % (32 * line) == 0 ? block_columns + line : block_columns;
}

}  // namespace

ColourTexture::ColourTexture(Index rows, Index columns, int channels, TextureCurve curve)
    : rows_(rows),
      columns_(columns),
      channels_(channels),
      curve_(curve),
      row_stride_(stride_of(block_columns())) {
  if (channels != 1 && channels != 3) fail<UsageError>("a texture of {} matrices: it holds 1 or 3", channels);
  if (curve.logarithmic && !(curve.range > 0 && curve.range <= 80))
    fail<UsageError>("a texture whose codes span {} natural logarithms: take more than 0 and at most 80",
                     curve.range);
  blocks_.reset(static_cast<Bc1Block*>(allocate_zeroed(block_bytes())));
  tables_.reset(static_cast<float*>(allocate_zeroed(3 * texture_table * sizeof(float))));
  fill_tables(curve, tables_.get());
}

void ColourTexture::set_block(Index row, Index column, const Bc1Block& block) {
  if (block.first < block.second || (block.first == block.second && block.indices != 0))
    fail<UsageError>("block ({}, {}) has three colours and black: only blocks of four colours are multiplied",
                     row, column);
  blocks_.get()[row * row_stride_ + column] = block;
}

float ColourTexture::texel(Index row, Index column, int channel) const {
  const Bc1Block& block = block_row(row / block_side)[column / block_side];
  const int colour = colour_channel(channel);
  const float* table = tables() + colour * texture_table;
  const int first = bc1_channel(block.first, colour);
  const int second = bc1_channel(block.second, colour);
  const int index = bc1_index(block, static_cast<int>(row % block_side * block_side + column % block_side));
  const float A = table[first];
  const float B = table[second];
  if (!curve_.logarithmic) {
    if (index == 0) return A;
    if (index == 1) return B;
    const float A_third = A * texture_third;
    const float B_third = B * texture_third;
    return index == 2 ? (A_third + A_third) + B_third : A_third + (B_third + B_third);
  }
  const float AA = A * A;
  const float BB = B * B;
  if (index == 0) return first == 0 ? 0 : AA * A;
  if (index == 1) return second == 0 ? 0 : BB * B;
  if (first == 0 && second == 0) return 0;
  return index == 2 ? AA * B : A * BB;
}

Eigen::MatrixXd materialize(const ColourTexture& texture, int channel) {
  Eigen::MatrixXd matrix(texture.rows(), texture.columns());
  for (Index c = 0; c < matrix.cols(); ++c)
    for (Index r = 0; r < matrix.rows(); ++r) matrix(r, c) = texture(r, c, channel);
  return matrix;
}

}  // namespace radiosity
