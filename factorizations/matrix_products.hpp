#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace radiosity {

/// An m x n matrix A that is known by its products only.
struct MatrixProducts {
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> apply;             ///< A X, X of n x c
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> apply_transposed;  ///< A' X, X of m x c

  /// Products with a stored matrix, which must outlive them.
  static MatrixProducts of(const Eigen::MatrixXd& matrix);
};

/// Columns of A, m x |which|.
Eigen::MatrixXd columns_of(const MatrixProducts& A, const std::vector<Eigen::Index>& which);

/// Rows of A, |which| x n.
Eigen::MatrixXd rows_of(const MatrixProducts& A, const std::vector<Eigen::Index>& which);

/// Independent standard normal numbers (Box and Muller); column j depends on the seed and j alone.
Eigen::MatrixXd normal_numbers(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed);

}  // namespace radiosity
