#include "operators/dense_operator.hpp"

#include "kernels/absolute_sums.hpp"
#include "kernels/stored_number.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/matrix_operator.hpp"
#include "operators/rounding_certificate.hpp"
#include "operators/storage_choice.hpp"
#include "operators/stored_matrix.hpp"

#include <algorithm>
#include <type_traits>

namespace radiosity {
namespace {

template <typename Scalar>
std::shared_ptr<const SymmetricTiles<Scalar>> stored_kernel(
    const std::shared_ptr<const SymmetricTiles<double>>& kernel) {
  if constexpr (std::is_same_v<Scalar, double>)
    return kernel;
  else
    return std::make_shared<const SymmetricTiles<Scalar>>(convert<Scalar>(*kernel));
}

template <typename Scalar>
std::shared_ptr<const RowMajorMatrix<Scalar>> stored_matrix(
    const std::shared_ptr<const RowMajorMatrix<double>>& matrix) {
  if constexpr (std::is_same_v<Scalar, double>)
    return matrix;
  else
    return std::make_shared<const RowMajorMatrix<Scalar>>(convert<Scalar>(*matrix));
}

template <typename Scalar>
class DenseKernelOperator final : public KernelOperator, public HasStoredMatrix {
 public:
  explicit DenseKernelOperator(const FormFactors& form_factors)
      : KernelOperator(form_factors), kernel_(stored_kernel<Scalar>(form_factors.kernel)) {}

  ByteCount bytes() const override {
    return {{{"entries", kernel_->entry_bytes()},
             {"directory", kernel_->directory_bytes()},
             {"diagonals", diagonal_bytes(size(), channels())}}};
  }
  std::string describe() const override { return storage_spec<Scalar>("dense"); }
  StoredMatrix stored() const override { return kernel_.get(); }
  double product_roundoff() const override { return std::is_same_v<Scalar, double> ? 0x1p-53 : 0x1p-24; }

  double product_error() const override {
    const double any_order = KernelOperator::product_error();
    return std::is_same_v<Scalar, double> ? std::min(any_order, tiled_product_error(size())) : any_order;
  }

  Certificate certificate() const override {
    const AbsoluteSums kernel = absolute_sums(*kernel_, root_area());
    const double underflow = underflow_error<Scalar>() * kernel_->scale() * static_cast<double>(size());
    return rounding_certificate(kernel.sums.cwiseQuotient(root_area()), kernel.non_negative, reflectance(),
                                root_area(), {product_rounding<Scalar>(size()), underflow});
  }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    multiply(*kernel_, X, Y, instructions_);
  }

 private:
  InstructionSet instructions_ = best_instruction_set();
  std::shared_ptr<const SymmetricTiles<Scalar>> kernel_;
};

template <typename Scalar>
class DenseMatrixOperator final : public MatrixOperator, public HasStoredMatrix {
 public:
  explicit DenseMatrixOperator(const FormFactors& form_factors)
      : MatrixOperator(form_factors), matrix_(stored_matrix<Scalar>(form_factors.unsymmetric)) {}

  ByteCount bytes() const override {
    return {{{"entries", matrix_->entry_bytes()}, {"diagonals", diagonal_bytes(size(), channels())}}};
  }
  std::string describe() const override { return storage_spec<Scalar>("dense"); }
  StoredMatrix stored() const override { return matrix_.get(); }
  double product_roundoff() const override { return std::is_same_v<Scalar, double> ? 0x1p-53 : 0x1p-24; }

  Certificate certificate() const override {
    const AbsoluteSums rows = absolute_sums(*matrix_, Eigen::VectorXd::Ones(size()));
    const double underflow =
        underflow_error<Scalar>() * matrix_->scale() * root_area().norm() * root_area().cwiseInverse().norm();
    return rounding_certificate(rows.sums, rows.non_negative, reflectance(), root_area(),
                                {product_rounding<Scalar>(size()), underflow});
  }

 protected:
  void multiply_matrix(const ConstFieldRef& X, FieldRef Y) const override {
    multiply(*matrix_, X, Y, instructions_);
  }
  void multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const override {
    multiply_transposed(*matrix_, X, Y, instructions_);
  }

 private:
  InstructionSet instructions_ = best_instruction_set();
  std::shared_ptr<const RowMajorMatrix<Scalar>> matrix_;
};

}  // namespace

std::unique_ptr<LinearOperator> make_dense_operator(Spec& spec, const FormFactors& form_factors) {
  const std::string storage = spec.choice("storage", "f64", {"f64", "f32", "f16"});
  spec.finish();
  if (storage == "f32") return make_stored<DenseKernelOperator, DenseMatrixOperator, float>(form_factors);
  if (storage == "f16") return make_stored<DenseKernelOperator, DenseMatrixOperator, Half>(form_factors);
  return make_stored<DenseKernelOperator, DenseMatrixOperator, double>(form_factors);
}

}  // namespace radiosity
