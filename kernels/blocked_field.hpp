#pragma once

#include "kernels/aligned_memory.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_products.hpp"

#include <vector>

namespace radiosity {

/// Some columns of a field in blocks of 64 rows as tile products read them: entry (64 b + i, c) is
/// block(b)[64 c + i]; rows beyond n are 0. float numbers are scaled, per column and tiles_together blocks,
/// by a power of two that puts the largest of them into [2^15, 2^16): nothing overflows, and products with
/// small matrix entries keep away from underflow.
template <typename Number>
class BlockedField {
 public:
  static constexpr Index block_size = 64;

  BlockedField(const ConstFieldRef& X, Index first_column, Index columns);

  Index blocks() const { return blocks_; }
  Index columns() const { return columns_; }
  const Number* block(Index b) const { return numbers_.data() + b * columns_ * block_size; }
  /// What the numbers of block b are to be multiplied by, one a column.
  const double* scale(Index b) const { return scales_.data() + b / tiles_together * columns_; }

 private:
  void fill_blocks(const ConstFieldRef& X, Index first_column, Index group);

  Index blocks_;
  Index columns_;
  AlignedBuffer<Number> numbers_;
  std::vector<double> scales_;
};

extern template class BlockedField<double>;
extern template class BlockedField<float>;

}  // namespace radiosity
