#pragma once

#include "kernels/products.hpp"

#include <string>

namespace radiosity {

/// Throws UsageError, naming the operator, unless X and Y are n x c with c a multiple of `channels` and share
/// no memory.
void check_fields(const std::string& operator_name, Index n, Index channels, const ConstFieldRef& X,
                  const FieldRef& Y);

/// Y *= beta; beta = 0 never reads Y.
void scale_field(double beta, FieldRef Y);

}  // namespace radiosity
