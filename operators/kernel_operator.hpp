#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// T = R A^{-1/2} K A^{1/2} for a symmetric kernel K (exact or approximate): the two diagonals live here, an
/// implementation only multiplies with K. One K serves every channel and reflectance, and CG applies.
class KernelOperator : public LinearOperator, public TransposedApply {
 public:
  Index size() const final { return root_area_.size(); }
  Index channels() const final { return reflectance_.cols(); }
  bool symmetric() const final { return true; }

  /// Y = K X for X and Y of n x c, any c; counted and timed like apply (a column is a product whatever
  /// channels() is).
  void apply_kernel(const ConstFieldRef& X, FieldRef Y) const;

  /// |Y - K X| <= this |K| |X|, component by component, for products as they are computed.
  virtual double product_error() const { return 2 * static_cast<double>(size() + 8) * product_roundoff(); }

  void apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const final;

  /// A^{1/2}, n.
  const Eigen::VectorXd& root_area() const { return root_area_; }
  /// rho, n x channels.
  const Eigen::MatrixXd& reflectance() const { return reflectance_; }
  /// Another reflectance for the same kernel, n x channels, 0 <= rho <= 1; throws UsageError otherwise.
  void set_reflectance(const Eigen::MatrixXd& reflectance);

 protected:
  /// Takes areas and reflectances from the mesh of `form_factors`.
  explicit KernelOperator(const FormFactors& form_factors);
  /// With the areas and reflectances of another operator.
  KernelOperator(Eigen::VectorXd root_area, Eigen::MatrixXd reflectance);

  /// Y = K X, c > 0; Y is written, never read.
  virtual void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const = 0;

  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const final;

 private:
  Eigen::VectorXd root_area_;
  Eigen::MatrixXd reflectance_;
};

}  // namespace radiosity
