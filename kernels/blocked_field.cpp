#include "kernels/blocked_field.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace radiosity {
namespace {

/// The power of two that the stored numbers of a column's block are to be multiplied by; 1 where none would
/// help (zeros, NaN, infinity).
double block_scale(const double* x, Index count) {
  double largest = 0;
  for (Index i = 0; i < count; ++i) largest = std::max(largest, std::fabs(x[i]));
  if (largest == 0 || !std::isfinite(largest)) return 1;
  // Below 2^-1000 the inverse of the scale would overflow.
  return std::ldexp(1.0, std::max(std::ilogb(largest) - 15, -1000));
}

}  // namespace

template <typename Number>
BlockedField<Number>::BlockedField(const ConstFieldRef& X, Index first_column, Index columns)
    : blocks_((X.rows() + block_size - 1) / block_size),
      columns_(columns),
      numbers_(static_cast<std::size_t>(blocks_ * columns * block_size)),
      scales_(static_cast<std::size_t>(blocks_ * columns), 1.0) {
  parallel_for(
      static_cast<std::size_t>(blocks_),
      [&](std::size_t b) { fill_block(X, first_column, static_cast<Index>(b)); }, 16);
}

template <typename Number>
void BlockedField<Number>::fill_block(const ConstFieldRef& X, Index first_column, Index b) {
  const Index count = std::min(block_size, X.rows() - b * block_size);
  Number* numbers = numbers_.data() + b * columns_ * block_size;
  for (Index c = 0; c < columns_; ++c, numbers += block_size) {
    const double* x = X.col(first_column + c).data() + b * block_size;
    double inverse = 1;
    if constexpr (std::is_same_v<Number, float>) {
      const double scale = block_scale(x, count);
      scales_[static_cast<std::size_t>(b * columns_ + c)] = scale;
      inverse = 1 / scale;
    }
    for (Index i = 0; i < count; ++i) numbers[i] = static_cast<Number>(x[i] * inverse);
    std::fill(numbers + count, numbers + block_size, Number{0});
  }
}

template class BlockedField<double>;
template class BlockedField<float>;

}  // namespace radiosity
