#include "factorizations/lapack.hpp"

#include "factorizations/blas_threads.hpp"
#include "foundation/error.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiosity {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

lapack_int as_lapack(Index size) {
  return static_cast<lapack_int>(size);
}

/// The threads for a matrix of this size: below it waking the others costs more than they save, and far more
/// where the machine is busy. Never a question of how many threads parallel_for may use, so that results are
/// the same whatever that is.
int threads_for(Index size) {
  constexpr Index worth_sharing = 1024;
  return size < worth_sharing ? 1 : BlasThreads::current();
}

void require_success(const char* routine, lapack_int info) {
  if (info != 0) fail("LAPACK's {} did not converge (info {}): is the matrix finite?", routine, info);
}

}  // namespace

SymmetricEigenpairs symmetric_eigenpairs(MatrixXd matrix) {
  const BlasThreads threads(threads_for(matrix.rows()));
  SymmetricEigenpairs result;
  result.values.resize(matrix.rows());
  if (matrix.rows() > 0)
    require_success("dsyevd", LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', as_lapack(matrix.rows()),
                                             matrix.data(), as_lapack(matrix.rows()), result.values.data()));
  result.vectors = std::move(matrix);
  return result;
}

SymmetricEigenpairs largest_in_magnitude(const SymmetricEigenpairs& pairs, Index count) {
  std::vector<Index> order(static_cast<std::size_t>(pairs.values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(pairs.values[a]) > std::abs(pairs.values[b]); });
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  return {pairs.values(order), pairs.vectors(Eigen::all, order)};
}

SingularValues singular_value_decomposition(MatrixXd matrix) {
  const Index rows = matrix.rows(), cols = matrix.cols(), rank = std::min(rows, cols);
  const BlasThreads threads(threads_for(rank));
  SingularValues result;
  result.U.resize(rows, rank);
  result.values.resize(rank);
  MatrixXd transposed(rank, cols);
  if (rank > 0)
    require_success("dgesdd",
                    LAPACKE_dgesdd(LAPACK_COL_MAJOR, 'S', as_lapack(rows), as_lapack(cols), matrix.data(),
                                   as_lapack(rows), result.values.data(), result.U.data(), as_lapack(rows),
                                   transposed.data(), as_lapack(rank)));
  result.V = transposed.transpose();
  return result;
}

PivotedQr pivoted_qr(MatrixXd matrix) {
  const Index rows = matrix.rows(), cols = matrix.cols(), rank = std::min(rows, cols);
  const BlasThreads threads(threads_for(rank));
  PivotedQr result;
  result.diagonal.resize(rank);
  result.pivots.resize(static_cast<std::size_t>(cols));
  if (rank == 0) {
    for (Index k = 0; k < cols; ++k) result.pivots[static_cast<std::size_t>(k)] = k;
    result.Q.resize(rows, 0);
    return result;
  }
  std::vector<lapack_int> pivots(static_cast<std::size_t>(cols), 0);
  VectorXd scales(rank);
  require_success("dgeqp3", LAPACKE_dgeqp3(LAPACK_COL_MAJOR, as_lapack(rows), as_lapack(cols), matrix.data(),
                                           as_lapack(rows), pivots.data(), scales.data()));
  for (Index k = 0; k < rank; ++k) result.diagonal[k] = std::abs(matrix(k, k));
  std::transform(pivots.begin(), pivots.end(), result.pivots.begin(),
                 [](lapack_int p) { return Index{p} - 1; });
  require_success("dorgqr", LAPACKE_dorgqr(LAPACK_COL_MAJOR, as_lapack(rows), as_lapack(rank),
                                           as_lapack(rank), matrix.data(), as_lapack(rows), scales.data()));
  result.Q = matrix.leftCols(rank);
  return result;
}

LuFactors::LuFactors(MatrixXd matrix) : triangles_(std::move(matrix)) {
  const lapack_int n = as_lapack(triangles_.rows());
  reciprocal_condition_ = 1;
  if (n == 0) return;
  const BlasThreads threads(threads_for(n));
  const double norm = triangles_.cwiseAbs().colwise().sum().maxCoeff();
  pivots_.resize(static_cast<std::size_t>(n));
  const lapack_int zero_pivot = LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, triangles_.data(), n, pivots_.data());
  reciprocal_condition_ = 0;
  if (zero_pivot == 0)
    LAPACKE_dgecon(LAPACK_COL_MAJOR, '1', n, triangles_.data(), n, norm, &reciprocal_condition_);
}

bool LuFactors::has_positive_determinant() const {
  bool positive = true;
  for (Index k = 0; k < size(); ++k) {
    const double pivot = triangles_(k, k);
    if (pivot == 0) return false;
    const bool exchanged = pivots_[static_cast<std::size_t>(k)] != k + 1;
    if (exchanged != (pivot < 0)) positive = !positive;
  }
  return positive;
}

MatrixXd LuFactors::solve(MatrixXd X) const {
  const lapack_int n = as_lapack(size());
  const BlasThreads threads(threads_for(std::min(size(), static_cast<Index>(X.cols()))));
  if (X.size() > 0)
    LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', n, as_lapack(X.cols()), triangles_.data(), n, pivots_.data(),
                   X.data(), n);
  return X;
}

MatrixXd orthonormal_columns(const MatrixXd& X, double tolerance) {
  const PivotedQr qr = pivoted_qr(X);
  Index rank = 0;
  while (rank < qr.diagonal.size() && qr.diagonal[rank] > tolerance * qr.diagonal[0]) ++rank;
  return qr.Q.leftCols(rank);
}

}  // namespace radiosity
