#pragma once

#include <Eigen/Core>

#include <vector>

namespace radiosity {

// Dense factorizations of LAPACK for matrices of doubles. Each throws Error if LAPACK does not converge.

struct SymmetricEigenpairs {
  Eigen::VectorXd values;   ///< rising unless said otherwise
  Eigen::MatrixXd vectors;  ///< orthonormal columns in the same order
};

/// All eigenpairs of a symmetric matrix, of which the lower triangle is read (dsyevd).
SymmetricEigenpairs symmetric_eigenpairs(Eigen::MatrixXd matrix);

/// The first `count` pairs (or as many as there are) where the largest in magnitude come first.
SymmetricEigenpairs largest_in_magnitude(const SymmetricEigenpairs& pairs, Eigen::Index count);

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

/// A = P L U (dgetrf) with an estimate of how near A is to a singular matrix (dgecon, 1-norm); 0 where a
/// pivot is 0.
class LuFactors {
 public:
  explicit LuFactors(Eigen::MatrixXd matrix);
  Eigen::Index size() const { return triangles_.rows(); }
  double reciprocal_condition() const { return reciprocal_condition_; }
  /// Whether det A > 0, as far as rounding tells.
  bool has_positive_determinant() const;
  /// A^{-1} X.
  Eigen::MatrixXd solve(Eigen::MatrixXd X) const;

 private:
  Eigen::MatrixXd triangles_;
  std::vector<int> pivots_;
  double reciprocal_condition_ = 0;
};

/// An orthonormal basis of the columns of X: columns that depend on the others to `tolerance` relative to the
/// largest are left out.
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& X, double tolerance = 1e-10);

}  // namespace radiosity
