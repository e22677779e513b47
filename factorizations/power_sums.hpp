#pragma once

#include <Eigen/Core>

namespace radiosity {

/// sum_{h=0}^{terms-1} A^h B for A of n x n and B of n x m, terms >= 1: by Horner's rule, terms - 1 products,
/// or by doubling the number of terms, which takes 2 to 4 for each bit of it, whichever are fewer.
Eigen::MatrixXd power_sum(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, long terms);

/// All terms: (I - A)^-1 B for a non-negative A. Throws Error if the spectral radius of A is not below 1, for
/// then there is no sum: it is, if and only if (I - A) x = 1 has a solution x >= 0 (x = 1 + A x proves it by
/// Collatz and Wielandt).
Eigen::MatrixXd geometric_sum(const Eigen::MatrixXd& A, Eigen::MatrixXd B);

}  // namespace radiosity
