#pragma once

#include "kernels/quantized_tiles.hpp"
#include "kernels/symmetric_tiles.hpp"
#include "operators/linear_operator.hpp"

namespace radiosity {

/// How far a non-negative approximation K~ is from K, entry by entry; rounding in double aside.
struct KernelError {
  double norm = 0;                ///< ||K~ - K||_2 <= this
  Eigen::VectorXd true_row_sums;  ///< of F, n: (K a)_i / a_i with a = A^{1/2}
  Eigen::VectorXd approximate_row_sums;
};

/// Reads both kernels once. The norm is the smaller of Frobenius's and of max_i (|K~ - K| a)_i / a_i, which
/// bounds the spectral radius of a symmetric matrix for any a > 0 (Collatz and Wielandt).
KernelError kernel_error(const SymmetricTiles<double>& K, const QuantizedTiles& approximation,
                         const Eigen::VectorXd& root_area);

/// The certificate of A = R A^{-1/2} K~ A^{1/2}, K~ >= 0, whose products are right to `rounding` |A| |X|:
/// rho(A) from its row sums, and ||A - T|| <= max rho (||K~ - K|| + rounding || |K~| ||) against ||T|| from
/// below, by its value for a uniform field.
Certificate approximation_certificate(const KernelError& error, double rounding,
                                      const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& root_area);

}  // namespace radiosity
