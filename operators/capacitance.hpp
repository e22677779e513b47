#pragma once

#include "factorizations/lapack.hpp"
#include "operators/distinct_reflectances.hpp"
#include "operators/low_rank_operator.hpp"

#include <utility>
#include <vector>

namespace radiosity {

/// C = I - M, M = V' R U, factored in double.
class CapacitanceMatrix {
 public:
  explicit CapacitanceMatrix(Eigen::MatrixXd C);

  /// C^{-1} X.
  Eigen::MatrixXd solve(Eigen::MatrixXd X) const { return factors_.solve(std::move(X)); }
  bool has_positive_determinant() const { return factors_.has_positive_determinant(); }

  /// 1 / ((1 + |M|) |C^{-1}|) in the 1-norm: the least change of M, in parts of 1 + |M|, that makes C
  /// singular. The usual reciprocal condition number, 1 / (|C| |C^{-1}|), forgets that C is a difference: of
  /// a 1 x 1 matrix it is 1, however near M is to 1.
  double reciprocal_condition() const { return reciprocal_condition_; }

 private:
  CapacitanceMatrix(Eigen::MatrixXd C, double norm, double norm_of_product);

  LuFactors factors_;
  double reciprocal_condition_;
};

/// The capacitance matrices C = I - V' R U of an operator T = R U V' of low rank (document 004, Eqs. 4 and
/// 5), k x k, one a distinct column of R.
class CapacitanceMatrices {
 public:
  explicit CapacitanceMatrices(const LowRankFactors& factors);

  const DistinctReflectances& reflectances() const { return reflectances_; }
  const CapacitanceMatrix& of_distinct(Index distinct) const {
    return matrices_[static_cast<std::size_t>(distinct)];
  }
  const CapacitanceMatrix& of_channel(Index channel) const {
    return of_distinct(reflectances_.of_channel(channel));
  }

  /// The smallest of any of them.
  double reciprocal_condition() const;

  /// Whether one of them is not to be told from a singular matrix: a reciprocal condition below n u.
  bool singular() const;

 private:
  DistinctReflectances reflectances_;
  std::vector<CapacitanceMatrix> matrices_;
  Index patches_;
};

}  // namespace radiosity
