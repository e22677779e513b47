#pragma once

#include "operators/kernel_operator.hpp"

namespace radiosity {

/// What bounds of the error of B~ start from: with S = R^{1/2} K R^{1/2}, w = R^{1/2} K A^{1/2} B and w~ the
/// same of B~, (I - S)(w - w~) = r and ||B - B~||_A <= ||R^{1/2} (w - w~)|| + moved (docs/theory.md, 5).
struct WeightedResidual {
  Field residual;               ///< r, n x c
  Eigen::RowVectorXd rounding;  ///< ||error of r|| as computed, one a column
  Eigen::RowVectorXd
      moved;          ///< where patches are nearly black, B~ is first replaced by a bounce of it: by so much
  Index columns = 0;  ///< multiplied with K for it
};

/// At the price of one product a column, or two where B~ differs from E on black patches. Throws UsageError
/// for wrong shapes.
WeightedResidual weighted_residual(const KernelOperator& truth, const Field& emission,
                                   const Field& radiosity);

/// Bounds of one or more answers.
struct ErrorBound {
  /// ||B - B~||_A <= this, one a column; infinite where nothing is known (the system may be singular).
  Eigen::RowVectorXd absolute;
  /// ||B - B~||_A <= this ||B||_A, one a light, all its channels together; infinite where B~ may be noise.
  Eigen::RowVectorXd relative;

  /// Absolute bounds, and the relative ones that follow from them and ||B~||_A.
  static ErrorBound of(const Eigen::RowVectorXd& absolute, const Eigen::VectorXd& root_area,
                       const Field& radiosity, Index channels);
};

/// max_i rho_i sum_j F_ij for every channel, rounding allowed for: rho(S) <= this.
Eigen::RowVectorXd largest_rows(const KernelOperator& truth);

}  // namespace radiosity
