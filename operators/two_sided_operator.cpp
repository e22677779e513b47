#include "operators/two_sided_operator.hpp"

#include "operators/storage_choice.hpp"

#include <utility>

namespace radiosity {

template <typename Scalar>
TwoSidedOperator<Scalar>::TwoSidedOperator(const FormFactors& form_factors, ElementPartition partition,
                                           const Eigen::MatrixXd& X, std::string spec, std::string remark)
    : KernelOperator(form_factors),
      partition_(std::move(partition)),
      X_(X),
      spec_(std::move(spec)),
      remark_(std::move(remark)) {
  indicator_.resize(X.rows());
  for (Index e = 0; e < X.rows(); ++e)
    indicator_[e] =
        root_area()[e] /
        std::sqrt(partition_.patch_area()[partition_.patch_of_element()[static_cast<std::size_t>(e)]]);
  // From the numbers as they are stored, so that the two halves fit.
  Field stored(X.rows(), X.cols());
  multiply(X_, Field::Identity(X.cols(), X.cols()), stored, instructions_);
  const Eigen::MatrixXd products = patch_components(stored);
  patch_products_ = 0.5 * (products + products.transpose());
}

template <typename Scalar>
Field TwoSidedOperator<Scalar>::patch_components(const ConstFieldRef& Y) const {
  Field components(X_.cols(), Y.cols());
  segment_sums(partition_.offsets(), partition_.order(), indicator_(partition_.order()), Y, components);
  return components;
}

template <typename Scalar>
Field TwoSidedOperator<Scalar>::combine(const ConstFieldRef& C1, const ConstFieldRef& C2) const {
  Field Y(size(), C1.cols());
  multiply(X_, C1, Y, instructions_);
  Y += indicator_.asDiagonal() * C2(partition_.patch_of_element(), Eigen::all);
  return Y;
}

template <typename Scalar>
void TwoSidedOperator<Scalar>::multiply_kernel(const ConstFieldRef& X, FieldRef Y) const {
  const Field components = patch_components(X);
  Field images(X_.cols(), X.cols());
  multiply_transposed(X_, X, images, instructions_);
  Y = combine(components, images - patch_products_ * components);
}

template <typename Scalar>
void TwoSidedOperator<Scalar>::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  Y = root_area().cwiseInverse().asDiagonal() * combine(C.topRows(X_.cols()), C.bottomRows(X_.cols()));
}

template <typename Scalar>
void TwoSidedOperator<Scalar>::multiply_right_transposed(const ConstFieldRef& Y, FieldRef C) const {
  const Field scaled = root_area().asDiagonal() * Y;
  const Field components = patch_components(scaled);
  Field images(X_.cols(), Y.cols());
  multiply_transposed(X_, scaled, images, instructions_);
  C.topRows(X_.cols()) = components;
  C.bottomRows(X_.cols()) = images - patch_products_ * components;
}

template <typename Scalar>
ByteCount TwoSidedOperator<Scalar>::bytes() const {
  return {{{"X", X_.entry_bytes()},
           {"patch products", static_cast<std::size_t>(patch_products_.size()) * sizeof(double)},
           {"indicators", static_cast<std::size_t>(size()) * (sizeof(double) + sizeof(int) + sizeof(Index))},
           {"diagonals", diagonal_bytes(size(), channels())}}};
}

template class TwoSidedOperator<double>;
template class TwoSidedOperator<float>;

}  // namespace radiosity
