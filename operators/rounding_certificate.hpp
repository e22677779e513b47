#pragma once

#include "operators/linear_operator.hpp"

namespace radiosity {

/// How far an operator that stores every entry can be from T, in units that its storage and its arithmetic
/// give.
struct RoundingError {
  double relative = 0;  ///< |A_ij - T_ij| <= this |T_ij|, with the arithmetic's componentwise bound in it
  double absolute =
      0;  ///< and beyond it (entries that underflow) at most this in the area norm, before reflectance
};

/// The componentwise relative error of a product with n columns whose entries are stored as Scalar (double,
/// float, Half): rounding the entries of T once, multiplying in float within a tile of 64 and adding up in
/// double.
template <typename Scalar>
double product_rounding(Index n);

/// The certificate of A = R L, from `row_sums` = |L| 1 (n), R = `reflectance` (n x channels), A^{1/2} =
/// `root_area`. For non-negative L both values are proved: rho(A) <= ||A||_inf, and |A - T| <= e |T| entry by
/// entry makes ||A - T|| <= e ||T|| in the area norm; ||T|| is bounded from below by its value for a uniform
/// field. A signed L leaves the second one open.
Certificate rounding_certificate(const Eigen::VectorXd& row_sums, bool non_negative,
                                 const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& root_area,
                                 const RoundingError& error);

}  // namespace radiosity
