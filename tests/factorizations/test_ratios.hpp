#pragma once

#include "factorizations/lapack.hpp"

namespace radiosity::testing {

constexpr double double_roundoff = 0x1p-53;

/// LAPACK's test ratios, at most 50 where all is well. ||I - Q'Q||_max / (n u).
double orthogonality(const Eigen::MatrixXd& Q);

/// ||A - U S V'||_F / (||A||_F n u), safe for numbers near either end of the range.
double residual(const Eigen::MatrixXd& A, const SingularValues& svd);

/// The larger of ||A V - U S||_F and ||A' U - V S||_F over ||A||_F n u, for some of the singular values.
double triplet_residual(const Eigen::MatrixXd& A, const SingularValues& svd);

}  // namespace radiosity::testing
