#include "factorizations/basis_projection.hpp"

#include "factorizations/lapack.hpp"

namespace radiosity {

LowRankPair project_on_columns(const MatrixProducts& A, const Eigen::MatrixXd& basis, double tolerance) {
  LowRankPair pair;
  pair.U = orthonormal_columns(basis, tolerance);
  pair.V = A.apply_transposed(pair.U);
  return pair;
}

}  // namespace radiosity
