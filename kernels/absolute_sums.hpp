#pragma once

#include "kernels/row_groups.hpp"
#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"

namespace radiosity {

/// |M| w for a vector w >= 0, in double: what bounds of norms and spectral radii are made of.
struct AbsoluteSums {
  Eigen::VectorXd sums;      ///< relative error of each <= (columns + 2) u of double
  bool non_negative = true;  ///< no stored number is below 0
};

template <typename Scalar>
AbsoluteSums absolute_sums(const SymmetricTiles<Scalar>& M, const Eigen::VectorXd& weights);
template <typename Scalar>
AbsoluteSums absolute_sums(const RowMajorMatrix<Scalar>& M, const Eigen::VectorXd& weights);
template <typename Scalar>
AbsoluteSums absolute_sums(const RowGroups<Scalar>& M, const Eigen::VectorXd& weights);

}  // namespace radiosity
