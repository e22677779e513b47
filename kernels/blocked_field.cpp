#include "kernels/blocked_field.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace radiosity {
namespace {

/// The power of two that the stored numbers of a column's group of blocks are to be multiplied by; 1 where
/// none would help (zeros, NaN, infinity).
double power_of_two_scale(const double* x, Index count) {
  // Side by side: one comparison waits for the one before it.
  constexpr Index lanes = 8;
  double largest_of_lane[lanes] = {};
  Index i = 0;
  for (; i + lanes <= count; i += lanes)
    for (Index k = 0; k < lanes; ++k) largest_of_lane[k] = std::max(largest_of_lane[k], std::fabs(x[i + k]));
  double largest = *std::max_element(largest_of_lane, largest_of_lane + lanes);
  for (; i < count; ++i) largest = std::max(largest, std::fabs(x[i]));
  if (largest == 0 || !std::isfinite(largest)) return 1;
  // Below 2^-1000 the inverse of the scale would overflow.
  return std::ldexp(1.0, std::max(std::ilogb(largest) - 15, -1000));
}

}  // namespace

template <typename Number>
BlockedField<Number>::BlockedField(const ConstFieldRef& X, Index first_column, Index columns)
    : blocks_((X.rows() + block_size - 1) / block_size),
      columns_(columns),
      numbers_(static_cast<std::size_t>(blocks_ * columns * block_size)) {
  const Index groups = (blocks_ + tiles_together - 1) / tiles_together;
  scales_.assign(static_cast<std::size_t>(groups * columns), 1.0);
  parallel_for(
      static_cast<std::size_t>(groups),
      [&](std::size_t group) { fill_blocks(X, first_column, static_cast<Index>(group)); }, 4);
}

template <typename Number>
void BlockedField<Number>::fill_blocks(const ConstFieldRef& X, Index first_column, Index group) {
  const Index first_row = group * tiles_together * block_size;
  const Index last_row = std::min(first_row + tiles_together * block_size, X.rows());
  for (Index c = 0; c < columns_; ++c) {
    const double* x = X.col(first_column + c).data();
    double inverse = 1;
    if constexpr (std::is_same_v<Number, float>) {
      const double scale = power_of_two_scale(x + first_row, last_row - first_row);
      scales_[static_cast<std::size_t>(group * columns_ + c)] = scale;
      inverse = 1 / scale;
    }
    for (Index row = first_row; row < last_row; row += block_size) {
      Number* numbers = numbers_.data() + (row * columns_) + c * block_size;
      const Index count = std::min(block_size, last_row - row);
      for (Index i = 0; i < count; ++i) numbers[i] = static_cast<Number>(x[row + i] * inverse);
      std::fill(numbers + count, numbers + block_size, Number{0});
    }
  }
}

template class BlockedField<double>;
template class BlockedField<float>;

}  // namespace radiosity
