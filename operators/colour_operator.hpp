#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

namespace radiosity {

/// The colour of each patch as a sender, n x channels: its reflectance, or 1 where that is 0. Document 000
/// multiplies F by it (F^c, Eq. 5) and puts the light L that arrives from outside in place of emission, so
/// that E = R L; with 1 in place of 0, black emitters, which have no L, keep their light.
Eigen::MatrixXd sender_colours(const Eigen::MatrixXd& reflectance);

/// What document 000 multiplies fields with, one n x n matrix M a channel, as an operator in this library's
/// convention: T ~ R M C^-1 for M = F^c = F C (Eq. 5), or E -> B = E + R M C^-1 E for M = sum over h = 1 ...
/// k of (F^c)^h (Eq. 8, whose h = 0 is the identity: S_k - I is stored).
class ColourOperator : public LinearOperator, public TransposedApply {
 public:
  Index size() const final { return reflectance_.rows(); }
  Index channels() const final { return reflectance_.cols(); }
  bool global() const final { return global_; }
  void apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const final;

  /// rho, n x channels.
  const Eigen::MatrixXd& reflectance() const { return reflectance_; }

 protected:
  ColourOperator(const FormFactors& form_factors, bool global);

  /// Y = M X and Y = M' X, c > 0; Y is written, never read.
  virtual void multiply_colours(const ConstFieldRef& X, FieldRef Y) const = 0;
  virtual void multiply_colours_transposed(const ConstFieldRef& X, FieldRef Y) const = 0;

  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const final;

 private:
  Eigen::MatrixXd reflectance_;
  Eigen::ArrayXXd inverse_colours_;  ///< 1 / c, n x channels
  bool global_;
};

}  // namespace radiosity
