#pragma once

#include "solvers/weighted_residual.hpp"

namespace radiosity {

struct RadauBoundOptions {
  double wanted_ratio = 1.3;  ///< of the upper to the lower bound of ||w - w~||, where a column ends
  int most_steps = 60;        ///< products a column, beside the residual's
};

struct RadauBound {
  ErrorBound bound;
  bool tight = true;    ///< every column came down to the wanted ratio; if not, its bound holds but is loose
  double products = 0;  ///< with the true kernel (columns / channels)
};

/// Bounds the error of B~ by Gauss-Radau quadrature (Golub and Meurant 1994): ||w - w~||^2 = r' (I - S)^-2 r
/// is an integral of x^-2, which k Lanczos steps from r bound from below by Gauss's rule, and from above by
/// Radau's with a node at mu = 1 - max_i rho_i sum_j F_ij, which lies below every eigenvalue of I - S: the
/// row sums prove it, and no eigenvector is needed. Some 3 to 15 products where light dies out; for one
/// answer that is cheaper than ErrorCertificate, whose eigenvectors serve any number of answers. Lanczos
/// vectors are kept orthogonal explicitly.
///
/// Bounds are infinite where mu <= 0. Throws UsageError for wrong shapes.
RadauBound radau_error_bound(const KernelOperator& truth, const Field& emission, const Field& radiosity,
                             const RadauBoundOptions& options = {});

}  // namespace radiosity
