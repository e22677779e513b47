#include "factorizations/cur.hpp"

#include "factorizations/lapack.hpp"
#include "factorizations/leading_columns.hpp"

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// As many rows of Q as it has columns, which make up a well conditioned matrix.
std::vector<Index> interpolation_rows(const MatrixXd& Q) {
  std::vector<Index> rows = pivoted_qr(Q.transpose()).pivots;
  rows.resize(static_cast<std::size_t>(Q.cols()));
  return rows;
}

}  // namespace

CurDecomposition cur_decomposition(const MatrixProducts& A, const CurOptions& options) {
  CurDecomposition cur;
  cur.columns = leading_columns(A, options.rank, options.seed);
  const MatrixXd Q = orthonormal_columns(columns_of(A, cur.columns));
  cur.rows = interpolation_rows(Q);
  const MatrixXd R = rows_of(A, cur.rows);
  if (options.core == CurCore::interpolation) {
    cur.factors.U = LuFactors(Q(cur.rows, Eigen::all).transpose()).solve(Q.transpose()).transpose();
    cur.factors.V = R.transpose();
    return cur;
  }
  cur.factors.V = orthonormal_columns(R.transpose());
  cur.factors.U = Q * (Q.transpose() * A.apply(cur.factors.V));
  return cur;
}

}  // namespace radiosity
