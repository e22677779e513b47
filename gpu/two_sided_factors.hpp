#pragma once

#include "operators/two_sided_operator.hpp"

namespace radiosity {

/// U = [Z, W] and V = [W, Z], n x 2k, of the kernel Z W' + W Z' = U V', in full: W, which has one number a
/// row, takes as much memory as Z then, and both are there twice.
template <typename Scalar>
TallMatrix<Scalar> full_left_factor(const TwoSidedOperator<Scalar>& kernel);
template <typename Scalar>
TallMatrix<Scalar> full_right_factor(const TwoSidedOperator<Scalar>& kernel);

}  // namespace radiosity
