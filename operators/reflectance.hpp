#pragma once

#include "kernels/products.hpp"

namespace radiosity {

/// Throws UsageError unless `reflectance` is n x channels (at least one) with 0 <= rho <= 1.
void check_reflectance(const Eigen::MatrixXd& reflectance, Index n);

/// Y = diag_c product + beta Y where column j takes the column j mod channels of `diagonals` (n x channels).
/// beta = 0 never reads Y. An exact 0 of the product stays 0.
void add_product(const Eigen::ArrayXXd& diagonals, const ConstFieldRef& product, double beta, FieldRef Y);

/// Y = alpha (E + reflected) + beta Y: what a global operator gives for the emission E. beta = 0 never reads
/// Y.
void add_answer(double alpha, const ConstFieldRef& E, const ConstFieldRef& reflected, double beta,
                FieldRef Y);

}  // namespace radiosity
