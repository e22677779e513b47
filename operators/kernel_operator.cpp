#include "operators/kernel_operator.hpp"

#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/field_checks.hpp"
#include "operators/reflectance.hpp"

#include <utility>

namespace radiosity {

KernelOperator::KernelOperator(const FormFactors& form_factors)
    : root_area_(form_factors.mesh->area.cwiseSqrt()), reflectance_(form_factors.mesh->reflectance) {
  check_reflectance(reflectance_, root_area_.size());
}

KernelOperator::KernelOperator(Eigen::VectorXd root_area, Eigen::MatrixXd reflectance)
    : root_area_(std::move(root_area)), reflectance_(std::move(reflectance)) {
  check_reflectance(reflectance_, root_area_.size());
}

void KernelOperator::set_reflectance(const Eigen::MatrixXd& reflectance) {
  check_reflectance(reflectance, size());
  if (reflectance.cols() != channels())
    fail<UsageError>("the new reflectance has {} channels, the operator {}", reflectance.cols(), channels());
  reflectance_ = reflectance;
}

void KernelOperator::apply_kernel(const ConstFieldRef& X, FieldRef Y) const {
  check_fields(describe(), size(), 1, X, Y);
  if (X.cols() == 0 || size() == 0) return;
  const Stopwatch watch;
  multiply_kernel(X, Y);
  count_products(X.cols() * channels(), watch.seconds());
}

void KernelOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  const Field scaled = root_area_.asDiagonal() * X;
  Field product(X.rows(), X.cols());
  multiply_kernel(scaled, product);
  add_product((alpha * reflectance_).array().colwise() / root_area_.array(), product, beta, Y);
}

void KernelOperator::apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  apply_checked(alpha, X, beta, Y, [&] {
    Field scaled(X.rows(), X.cols());
    add_product(reflectance_.array().colwise() / root_area_.array(), X, 0, scaled);
    Field product(X.rows(), X.cols());
    multiply_kernel(scaled, product);
    add_product((alpha * root_area_).replicate(1, channels()), product, beta, Y);
  });
}

}  // namespace radiosity
