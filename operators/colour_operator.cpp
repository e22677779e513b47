#include "operators/colour_operator.hpp"

#include "operators/reflectance.hpp"

namespace radiosity {

Eigen::MatrixXd sender_colours(const Eigen::MatrixXd& reflectance) {
  return reflectance.unaryExpr([](double rho) { return rho > 0 ? rho : 1.0; });
}

ColourOperator::ColourOperator(const FormFactors& form_factors, bool global)
    : reflectance_(form_factors.mesh->reflectance), global_(global) {
  check_reflectance(reflectance_, form_factors.patch_count());
  inverse_colours_ = sender_colours(reflectance_).array().inverse();
}

void ColourOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  Field scaled(X.rows(), X.cols());
  add_product(inverse_colours_, X, 0, scaled);
  Field product(X.rows(), X.cols());
  multiply_colours(scaled, product);
  if (global()) {
    Field reflected(X.rows(), X.cols());
    add_product(reflectance_.array(), product, 0, reflected);
    add_answer(alpha, X, reflected, beta, Y);
  } else {
    add_product(alpha * reflectance_.array(), product, beta, Y);
  }
}

void ColourOperator::apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  apply_checked(alpha, X, beta, Y, [&] {
    Field scaled(X.rows(), X.cols());
    add_product(reflectance_.array(), X, 0, scaled);
    Field product(X.rows(), X.cols());
    multiply_colours_transposed(scaled, product);
    add_product(alpha * inverse_colours_, product, beta, Y);
    if (global()) Y += alpha * X;
  });
}

}  // namespace radiosity
