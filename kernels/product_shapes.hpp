#pragma once

#include "foundation/error.hpp"
#include "kernels/products.hpp"

namespace radiosity {

/// Throws UsageError unless Y (rows x c) = M (rows x cols) X (cols x c) makes sense.
inline void check_product_shapes(Index rows, Index cols, const ConstFieldRef& X, const FieldRef& Y) {
  if (X.rows() != cols || Y.rows() != rows || X.cols() != Y.cols())
    fail<UsageError>("a {} x {} matrix cannot multiply X of {} x {} into Y of {} x {}", rows, cols, X.rows(),
                     X.cols(), Y.rows(), Y.cols());
}

/// At most this many columns of X are worked on at a time, to bound the memory of partial sums.
constexpr Index columns_at_once = 16;

}  // namespace radiosity
