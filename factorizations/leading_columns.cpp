#include "factorizations/leading_columns.hpp"

#include "factorizations/lapack.hpp"

#include <algorithm>

namespace radiosity {

Eigen::MatrixXd row_sketch(const MatrixProducts& A, Eigen::Index rows, std::uint64_t seed) {
  if (rows >= A.rows) return A.apply_transposed(Eigen::MatrixXd::Identity(A.rows, A.rows)).transpose();
  return A.apply_transposed(normal_numbers(A.rows, rows, seed)).transpose();
}

std::vector<Eigen::Index> leading_columns(const MatrixProducts& A, Eigen::Index count, std::uint64_t seed) {
  constexpr double rank_tolerance = 1e-10;
  constexpr Eigen::Index fewest_more = 10;
  PivotedQr qr = pivoted_qr(row_sketch(A, count + std::max(fewest_more, count / 4), seed));
  Eigen::Index rank = 0;
  while (rank < std::min(count, qr.diagonal.size()) && qr.diagonal[rank] > rank_tolerance * qr.diagonal[0])
    ++rank;
  qr.pivots.resize(static_cast<std::size_t>(rank));
  return qr.pivots;
}

}  // namespace radiosity
