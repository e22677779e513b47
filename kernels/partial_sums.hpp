#pragma once

#include "kernels/aligned_memory.hpp"
#include "kernels/products.hpp"

#include <vector>

namespace radiosity {

/// The sums of a product that is split into chunks of work: each chunk adds into its own blocks (of 64 rows,
/// laid out as in BlockedField), and they are added in the order of the chunks. So the result does not depend
/// on which thread does what. Chunk k touches the blocks first_block[k] ... blocks - 1.
class PartialSums {
 public:
  PartialSums(Index blocks, Index columns, std::vector<Index> first_block);

  Index chunks() const { return static_cast<Index>(first_block_.size()); }

  /// Zeroes the chunk's sums. Called once a chunk, before block().
  void start(Index chunk);
  double* block(Index chunk, Index b) const {
    const auto k = static_cast<std::size_t>(chunk);
    return sums_.data() + (offset_[k] + b - first_block_[k]) * columns_ * 64;
  }

  /// Y(:, first_column ...) = scale times the sum over chunks.
  void finish(double scale, Index first_column, FieldRef Y) const;

 private:
  Index blocks_;
  Index columns_;
  std::vector<Index> first_block_;
  std::vector<Index> offset_;  ///< of each chunk's sums, in blocks; the last is the total
  AlignedBuffer<double> sums_;
};

}  // namespace radiosity
