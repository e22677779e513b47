#include "operators/matrix_operator.hpp"

#include "operators/reflectance.hpp"

namespace radiosity {

MatrixOperator::MatrixOperator(const FormFactors& form_factors)
    : root_area_(form_factors.mesh->area.cwiseSqrt()), reflectance_(form_factors.mesh->reflectance) {
  check_reflectance(reflectance_, root_area_.size());
}

void MatrixOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  if (beta == 0) {  // in place: n may be so large that another field matters
    multiply_matrix(X, Y);
    for (Index j = 0; j < Y.cols(); ++j) Y.col(j).array() *= alpha * reflectance_.col(j % channels()).array();
    return;
  }
  Field product(X.rows(), X.cols());
  multiply_matrix(X, product);
  add_product(alpha * reflectance_.array(), product, beta, Y);
}

void MatrixOperator::apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  apply_checked(alpha, X, beta, Y, [&] {
    Field scaled(X.rows(), X.cols());
    add_product(reflectance_.array(), X, 0, scaled);
    Field product(X.rows(), X.cols());
    multiply_matrix_transposed(scaled, product);
    add_product(Eigen::ArrayXXd::Constant(size(), 1, alpha), product, beta, Y);
  });
}

}  // namespace radiosity
