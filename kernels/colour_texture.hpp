#pragma once

#include "kernels/aligned_memory.hpp"
#include "kernels/block_formats.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>

namespace radiosity {

using Index = Eigen::Index;

/// What the codes of a texture stand for: of a code between 0 and 255, as a part p of 255, the number
/// p (linear) or exp(range (p - 1)) (logarithmic: document 000's map), times the channel's scale. A code of 0
/// is the number 0 in both.
struct TextureCurve {
  bool logarithmic = true;
  double range = 25;  ///< natural logarithms from code 0 to 255; not used where linear
};

/// Three matrices of one shape in a texture of BC1 blocks, a channel each, or one matrix (green, which has
/// most bits). Blocks lie by rows of blocks, as in a DDS file, of which each is padded to 16 blocks (64
/// columns) with black. Blocks have four colours: first > second, or first == second and all indices 0.
///
/// Numbers are those of float arithmetic without fused operations: with A = table[first], B = table[second],
/// the palette is A, B, 2 A/3 + B/3, A/3 + 2 B/3 where linear (A/3 is A times float(1/3)), and, with a table
/// of cube roots, A^3, B^3, A^2 B, A B^2 where logarithmic, with 0 in place of A^3 if its code is 0, of B^3
/// if its code is, and of the other two if both are. They are the same bits everywhere.
class ColourTexture {
 public:
  static constexpr Index block_side = 4;
  static constexpr Index blocks_together = 16;  ///< each row of blocks is a multiple of these
  static constexpr Index columns_together = block_side * blocks_together;

  /// All zero. `channels`: 1 or 3. Throws UsageError for other numbers and ranges that are not positive.
  ColourTexture(Index rows, Index columns, int channels, TextureCurve curve);

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  int channels() const { return channels_; }
  const TextureCurve& curve() const { return curve_; }

  Index block_rows() const { return (rows_ + block_side - 1) / block_side; }
  /// Padding included.
  Index block_columns() const {
    return (columns_ + columns_together - 1) / columns_together * blocks_together;
  }
  const Bc1Block* block_row(Index row) const { return blocks_.get() + row * block_row_stride(); }
  /// Blocks from one row of them to the next.
  Index block_row_stride() const { return row_stride_; }
  /// Throws UsageError where the block has not four colours. Different blocks may be set from different
  /// threads at once.
  void set_block(Index row, Index column, const Bc1Block& block);

  /// The number that code 255 stands for.
  double scale(int channel) const { return scales_[static_cast<std::size_t>(channel)]; }
  void set_scale(int channel, double scale) { scales_[static_cast<std::size_t>(channel)] = scale; }

  /// The colour channel in which matrix `channel` is: green if there is one.
  int colour_channel(int channel) const { return channels_ == 1 ? 1 : channel; }

  /// For each colour channel the numbers of its 32 or 64 codes, 64 apart.
  const float* tables() const { return tables_.get(); }

  /// The number without its scale, in float as the products have it: the plain reference.
  float texel(Index row, Index column, int channel) const;
  /// scale() times it.
  double operator()(Index row, Index column, int channel) const {
    return scale(channel) * static_cast<double>(texel(row, column, channel));
  }

  std::size_t block_bytes() const {
    return static_cast<std::size_t>(block_rows() * block_row_stride()) * sizeof(Bc1Block);
  }

 private:
  Index rows_;
  Index columns_;
  int channels_;
  TextureCurve curve_;
  Index row_stride_;
  std::array<double, 3> scales_{1, 1, 1};
  std::unique_ptr<Bc1Block[], AlignedRelease> blocks_;
  std::unique_ptr<float[], AlignedRelease> tables_;
};

/// One matrix in full, rows x columns, scaled: the plain reference, and for small ones.
Eigen::MatrixXd materialize(const ColourTexture& texture, int channel);

}  // namespace radiosity
