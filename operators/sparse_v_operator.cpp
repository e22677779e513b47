#include "operators/sparse_v_operator.hpp"

#include "form_factors/patch_sums.hpp"
#include "operators/storage_choice.hpp"

#include <utility>

namespace radiosity {

template <typename Scalar>
SparseVOperator<Scalar>::SparseVOperator(const FormFactors& form_factors, ElementPartition partition,
                                         FactorMatrix<Scalar> U, std::string spec, std::string remark)
    : MatrixOperator(form_factors),
      partition_(std::move(partition)),
      U_(std::move(U)),
      spec_(std::move(spec)),
      remark_(std::move(remark)) {
  if (!partition_.equal_areas()) weights_ = form_factors.mesh->area(partition_.order());
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_left_sorted(const ConstFieldRef& C, FieldRef Y) const {
  multiply(U_, C, Y, instructions_);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_right_transposed_sorted(const ConstFieldRef& X, FieldRef C) const {
  segment_sums(partition_.offsets(), weights_, X, C);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  Field sorted(size(), C.cols());
  multiply_left_sorted(C, sorted);
  Y(partition_.order(), Eigen::all) = sorted;
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  segment_sums(partition_.offsets(), partition_.order(), weights_, X, C);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_matrix(const ConstFieldRef& X, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  multiply_right_transposed(X, coefficients);
  multiply_left(coefficients, Y);
}

template <typename Scalar>
void SparseVOperator<Scalar>::multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const {
  const Field sorted = X(partition_.order(), Eigen::all);
  Field coefficients(rank(), X.cols());
  multiply_transposed(U_, sorted, coefficients, instructions_);
  for (Index p = 0; p < rank(); ++p)
    for (Index s = partition_.offsets()[static_cast<std::size_t>(p)];
         s < partition_.offsets()[static_cast<std::size_t>(p) + 1]; ++s) {
      const double weight = weights_.size() > 0 ? weights_[s] : 1;
      Y.row(partition_.order()[static_cast<std::size_t>(s)]) = weight * coefficients.row(p);
    }
}

template <typename Scalar>
ByteCount SparseVOperator<Scalar>::bytes() const {
  ByteCount bytes{{{"U", U_.entry_bytes()},
                   {"offsets", partition_.offsets().size() * sizeof(Index)},
                   {"permutation", partition_.order().size() * sizeof(Index)},
                   {"diagonals", diagonal_bytes(size(), channels())}}};
  if (weights_.size() > 0)
    bytes.parts.emplace_back("areas", static_cast<std::size_t>(weights_.size()) * sizeof(double));
  return bytes;
}

template class SparseVOperator<double>;
template class SparseVOperator<float>;

}  // namespace radiosity
