#pragma once

#include "experiments/lights.hpp"
#include "experiments/low_rank_radiosity/best_rank.hpp"
#include "experiments/low_rank_radiosity/error_study.hpp"
#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace radiosity {

/// F ~ U V' as an operator keeps it, in double, and what it takes to keep it.
struct LowRankParts {
  Eigen::MatrixXd U;             ///< n x rank
  Eigen::MatrixXd V;             ///< n x rank
  std::size_t column_bytes = 0;  ///< of everything that grows with k
  std::size_t other_bytes = 0;

  std::size_t bytes() const { return column_bytes + other_bytes; }
  /// The parts of rank k of a nested factorization.
  LowRankParts leading(Index k) const;
};

/// Builds the operator and reads its factors by products. Throws UsageError if it is not of low rank.
LowRankParts low_rank_parts(const OperatorRegistry& operators, const std::string& spec,
                            const FormFactors& form_factors);

/// Squared lengths of the rows of A^{1/2} (F - U V') A^{-1/2}, n: what is between F and its approximation,
/// whatever the reflectance. `kernel` is K.
Eigen::VectorXd squared_row_errors(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& area,
                                   const LowRankParts& parts);

/// ||R D||_F / ||R K||_F over all channels, from squared lengths of the rows of D and of K.
double relative_operator_error(const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& difference_rows,
                               const Eigen::VectorXd& kernel_rows);

/// B = E + T B by LU of I - R K, channel by channel.
Field solve_densely(const Eigen::MatrixXd& kernel, const PatchMesh& mesh, const Field& emission);

/// 0 of no values.
double mean_of(const std::vector<double>& values);

/// Errors of `approximation` for `lights`, whose kinds are in `set`.
LightErrors light_errors(const PatchMesh& mesh, const LightSet& set, const Field& radiosity,
                         const Field& approximation);

}  // namespace radiosity
