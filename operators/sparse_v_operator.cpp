#include "operators/sparse_v_operator.hpp"

#include "kernels/products.hpp"
#include "kernels/segment_products.hpp"
#include "kernels/segment_sums.hpp"
#include "operators/storage_choice.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {

template <typename Scalar>
SparseVOperator<Scalar>::SparseVOperator(const FormFactors& form_factors, Segments V, FactorMatrix<Scalar> U,
                                         std::string spec, std::string remark)
    : MatrixOperator(form_factors),
      V_(std::move(V)),
      U_(std::move(U)),
      spec_(std::move(spec)),
      remark_(std::move(remark)) {}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_left_sorted(const ConstFieldRef& C, FieldRef Y) const {
  multiply(U_, C, Y, instructions_);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_right_transposed_sorted(const ConstFieldRef& X, FieldRef C) const {
  segment_sums(V_, X, C, RowOrder::sorted);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  if (V_.order().empty()) return multiply_left_sorted(C, Y);
  // Some rows at a time: they go where they belong while they are in the cache, and take no second field.
  constexpr Index panels_at_once = 512;
  constexpr Index rows_at_once = panels_at_once * FactorMatrix<Scalar>::panel_rows;
  Field sorted(std::min(rows_at_once, size()), C.cols());
  for (Index first = 0; first < size(); first += rows_at_once) {
    const Index rows = std::min(rows_at_once, size() - first);
    multiply_panels(U_, first / FactorMatrix<Scalar>::panel_rows, C, sorted.topRows(rows), instructions_);
    for (Index j = 0; j < C.cols(); ++j)
      for (Index i = 0; i < rows; ++i) Y(V_.order()[static_cast<std::size_t>(first + i)], j) = sorted(i, j);
  }
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  segment_sums(V_, X, C);
}

template <typename Scalar>
std::vector<Eigen::MatrixXd> SparseVOperator<Scalar>::multiply_between(const ConstFieldRef& diagonals) const {
  std::vector<Eigen::MatrixXd> products;
  for (Index d = 0; d < diagonals.cols(); ++d) {
    const Eigen::VectorXd sorted =
        V_.order().empty() ? Eigen::VectorXd(diagonals.col(d)) : Eigen::VectorXd(diagonals(V_.order(), d));
    products.emplace_back(transposed_segment_products(V_, sorted, U_).transpose());
  }
  return products;
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_matrix(const ConstFieldRef& X, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  multiply_right_transposed(X, coefficients);
  multiply_left(coefficients, Y);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  if (V_.order().empty()) {
    multiply_transposed(U_, X, coefficients, instructions_);
  } else {
    const Field sorted = X(V_.order(), Eigen::all);
    multiply_transposed(U_, sorted, coefficients, instructions_);
  }
  spread_segments(V_, coefficients, Y);
}

template <typename Scalar>
ByteCount SparseVOperator<Scalar>::bytes() const {
  ByteCount bytes{{{"U", U_.entry_bytes()}, {"offsets", V_.offset_bytes()}}};
  if (V_.order_bytes() > 0) bytes.parts.emplace_back("permutation", V_.order_bytes());
  if (V_.weight_bytes() > 0) bytes.parts.emplace_back("areas", V_.weight_bytes());
  bytes.parts.emplace_back("diagonals", diagonal_bytes(size(), channels()));
  return bytes;
}

template class SparseVOperator<double>;
template class SparseVOperator<float>;

}  // namespace radiosity
