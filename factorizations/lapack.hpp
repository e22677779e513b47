#pragma once

#include <Eigen/Core>

#include <vector>

namespace radiosity {

// Dense factorizations of LAPACK for matrices of doubles. Each throws Error if LAPACK does not converge.

struct SymmetricEigenpairs {
  Eigen::VectorXd values;   ///< rising
  Eigen::MatrixXd vectors;  ///< orthonormal columns in the same order
};

/// All eigenpairs of a symmetric matrix, of which the lower triangle is read (dsyevd).
SymmetricEigenpairs symmetric_eigenpairs(Eigen::MatrixXd matrix);

struct SingularValues {
  Eigen::MatrixXd U;       ///< m x min(m, n)
  Eigen::VectorXd values;  ///< falling
  Eigen::MatrixXd V;       ///< n x min(m, n)
};

/// A = U diag(values) V' (dgesdd).
SingularValues singular_value_decomposition(Eigen::MatrixXd matrix);

struct PivotedQr {
  Eigen::MatrixXd Q;                 ///< m x min(m, n), orthonormal columns
  Eigen::VectorXd diagonal;          ///< |R_kk|, falling
  std::vector<Eigen::Index> pivots;  ///< column k of A P is column pivots[k] of A
};

/// QR with column pivoting, A P = Q R (dgeqp3).
PivotedQr pivoted_qr(Eigen::MatrixXd matrix);

/// An orthonormal basis of the columns of X: columns that depend on the others to `tolerance` relative to the
/// largest are left out.
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& X, double tolerance = 1e-10);

}  // namespace radiosity
