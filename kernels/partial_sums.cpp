#include "kernels/partial_sums.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace radiosity {
namespace {

std::vector<Index> block_offsets(Index blocks, const std::vector<Index>& first_block) {
  std::vector<Index> offsets = {0};
  for (const Index first : first_block) offsets.push_back(offsets.back() + blocks - first);
  return offsets;
}

}  // namespace

PartialSums::PartialSums(Index blocks, Index columns, std::vector<Index> first_block)
    : blocks_(blocks),
      columns_(columns),
      first_block_(std::move(first_block)),
      offset_(block_offsets(blocks, first_block_)),
      sums_(static_cast<std::size_t>(offset_.back() * columns * 64)) {}

void PartialSums::start(Index chunk) {
  const auto k = static_cast<std::size_t>(chunk);
  std::fill(sums_.data() + offset_[k] * columns_ * 64, sums_.data() + offset_[k + 1] * columns_ * 64, 0.0);
}

void PartialSums::finish(double scale, Index first_column, FieldRef Y) const {
  const auto finish_block = [&](std::size_t index) {
    const auto b = static_cast<Index>(index);
    const Index rows = std::min<Index>(64, Y.rows() - 64 * b);
    for (Index c = 0; c < columns_; ++c) {
      std::array<double, 64> sum{};
      for (Index chunk = 0; chunk < chunks(); ++chunk) {
        if (first_block_[static_cast<std::size_t>(chunk)] > b) continue;
        const double* part = block(chunk, b) + 64 * c;
        for (std::size_t i = 0; i < 64; ++i) sum[i] += part[i];
      }
      double* y = Y.col(first_column + c).data() + 64 * b;
      for (Index i = 0; i < rows; ++i) y[i] = scale * sum[static_cast<std::size_t>(i)];
    }
  };
  parallel_for(static_cast<std::size_t>(blocks_), finish_block, 4);
}

}  // namespace radiosity
