#pragma once

#include "factorizations/matrix_products.hpp"

namespace radiosity {

/// Two thin factors, A ~ U V'.
struct LowRankPair {
  Eigen::MatrixXd U;  ///< m x k
  Eigen::MatrixXd V;  ///< n x k
};

/// The best approximation of A whose columns lie in the span of the columns of `basis` (m x k): U, an
/// orthonormal basis of that span, and V = A' U (document 004, section 3.2: V_QR = (RF)' U_QR). Columns of
/// `basis` that depend on the others to `tolerance` relative to the largest are left out, so that the factors
/// may have fewer. One product with A' a column.
LowRankPair project_on_columns(const MatrixProducts& A, const Eigen::MatrixXd& basis,
                               double tolerance = 1e-10);

}  // namespace radiosity
