#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

namespace radiosity {

/// T = R F for an unsymmetric F that an implementation multiplies with in both directions; the reflectances
/// live here.
class MatrixOperator : public LinearOperator, public TransposedApply {
 public:
  Index size() const final { return reflectance_.rows(); }
  Index channels() const final { return reflectance_.cols(); }
  void apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const final;

  /// rho, n x channels.
  const Eigen::MatrixXd& reflectance() const { return reflectance_; }
  /// A^{1/2}, n.
  const Eigen::VectorXd& root_area() const { return root_area_; }

 protected:
  explicit MatrixOperator(const FormFactors& form_factors);

  /// Y = F X and Y = F' X, c > 0; Y is written, never read.
  virtual void multiply_matrix(const ConstFieldRef& X, FieldRef Y) const = 0;
  virtual void multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const = 0;

  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const final;

 private:
  Eigen::VectorXd root_area_;
  Eigen::MatrixXd reflectance_;
};

}  // namespace radiosity
