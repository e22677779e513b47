#pragma once

#include "operators/kernel_operator.hpp"

namespace radiosity {

/// |B_ij - B~_ij| <= the result, n x c, proved for every patch and column, where B = E + T B with the true,
/// non-negative T. (I - T)(B - B~) = r, the residual; if y > 0 and (I - T) y >= |r| + d entry by entry with d
/// > 0, then T is a contraction, (I - T)^{-1} is not negative, and |B - B~| <= (I - T)^{-1} |r| <= y. So y is
/// computed as a solution for |r| + d and the inequality checked with one more product, rounding allowed for.
/// Signs in r do not cancel here: patch by patch the bound is within a small factor of the error where light
/// dies out quickly, and too large by up to 1 / (1 - reflectance) where it does not; for the whole answer
/// ErrorCertificate is tighter.
///
/// Throws UsageError for wrong shapes and Error if no such y is found (the system is nearly singular).
Field patch_error_bounds(const KernelOperator& truth, const Field& emission, const Field& radiosity);

}  // namespace radiosity
