#include "operators/two_sided_operator.hpp"

#include "kernels/segment_sums.hpp"
#include "operators/storage_choice.hpp"

#include <utility>

namespace radiosity {
namespace {

/// X - 1/2 W (W'X).
Eigen::MatrixXd symmetric_half(const Segments& W, const Eigen::MatrixXd& X) {
  Field products(X.cols(), X.cols());
  segment_sums(W, X, products);
  Field spread(X.rows(), X.cols());
  spread_segments(W, products, spread);
  return X - 0.5 * spread;
}

}  // namespace

template <typename Scalar>
TwoSidedOperator<Scalar>::TwoSidedOperator(const FormFactors& form_factors, Segments W,
                                           const Eigen::MatrixXd& X, std::string spec, std::string remark)
    : KernelOperator(form_factors),
      W_(std::move(W)),
      Z_(symmetric_half(W_, X)),
      spec_(std::move(spec)),
      remark_(std::move(remark)) {}

template <typename Scalar>
Field TwoSidedOperator<Scalar>::components(const ConstFieldRef& Y) const {
  Field result(rank(), Y.cols());
  segment_sums(W_, Y, result.topRows(Z_.columns()));
  multiply_transposed(Z_, Y, result.bottomRows(Z_.columns()), instructions_);
  return result;
}

template <typename Scalar>
Field TwoSidedOperator<Scalar>::combine(const ConstFieldRef& C) const {
  Field Y(size(), C.cols());
  multiply(Z_, C.topRows(Z_.columns()), Y, instructions_);
  Field spread(size(), C.cols());
  spread_segments(W_, C.bottomRows(Z_.columns()), spread);
  return Y + spread;
}

template <typename Scalar>
void TwoSidedOperator<Scalar>::multiply_kernel(const ConstFieldRef& X, FieldRef Y) const {
  Y = combine(components(X));
}

template <typename Scalar>
void TwoSidedOperator<Scalar>::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  Y = root_area().cwiseInverse().asDiagonal() * combine(C);
}

template <typename Scalar>
void TwoSidedOperator<Scalar>::multiply_right_transposed(const ConstFieldRef& Y, FieldRef C) const {
  C = components(root_area().asDiagonal() * Y);
}

template <typename Scalar>
std::size_t TwoSidedOperator<Scalar>::indicator_bytes() const {
  return W_.weight_bytes() + W_.order_bytes() + W_.offset_bytes();
}

template <typename Scalar>
std::size_t TwoSidedOperator<Scalar>::right_bytes() const {
  return Z_.entry_bytes() + indicator_bytes() + static_cast<std::size_t>(size()) * sizeof(double);
}

template <typename Scalar>
ByteCount TwoSidedOperator<Scalar>::bytes() const {
  return {{{"Z", Z_.entry_bytes()},
           {"indicators", indicator_bytes()},
           {"diagonals", diagonal_bytes(size(), channels())}}};
}

template class TwoSidedOperator<double>;
template class TwoSidedOperator<float>;

}  // namespace radiosity
