#include "operators/csr_operator.hpp"

#include "kernels/absolute_sums.hpp"
#include "kernels/stored_number.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/matrix_operator.hpp"
#include "operators/rounding_certificate.hpp"
#include "operators/storage_choice.hpp"
#include "operators/stored_matrix.hpp"

namespace radiosity {
namespace {

template <typename Scalar>
ByteCount csr_bytes(const RowGroups<Scalar>& matrix, Index n, Index channels) {
  return {{{"entries", matrix.value_bytes()},
           {"indices", matrix.index_bytes()},
           {"diagonals", diagonal_bytes(n, channels)}}};
}

template <typename Scalar>
class CsrKernelOperator final : public KernelOperator, public HasStoredMatrix {
 public:
  explicit CsrKernelOperator(const FormFactors& form_factors)
      : KernelOperator(form_factors), kernel_(compress<Scalar>(*form_factors.kernel)) {}

  ByteCount bytes() const override { return csr_bytes(kernel_, size(), channels()); }
  std::string describe() const override { return storage_spec<Scalar>("csr"); }
  StoredMatrix stored() const override { return &kernel_; }

  Certificate certificate() const override {
    const AbsoluteSums kernel = absolute_sums(kernel_, root_area());
    const double underflow = underflow_error<Scalar>() * static_cast<double>(size());
    return rounding_certificate(kernel.sums.cwiseQuotient(root_area()), kernel.non_negative, reflectance(),
                                root_area(), {product_rounding<Scalar>(size()), underflow});
  }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override { multiply(kernel_, X, Y); }

 private:
  RowGroups<Scalar> kernel_;
};

template <typename Scalar>
class CsrMatrixOperator final : public MatrixOperator, public HasStoredMatrix {
 public:
  explicit CsrMatrixOperator(const FormFactors& form_factors)
      : MatrixOperator(form_factors), matrix_(compress<Scalar>(*form_factors.unsymmetric)) {}

  ByteCount bytes() const override { return csr_bytes(matrix_, size(), channels()); }
  std::string describe() const override { return storage_spec<Scalar>("csr"); }
  StoredMatrix stored() const override { return &matrix_; }

  Certificate certificate() const override {
    const AbsoluteSums rows = absolute_sums(matrix_, Eigen::VectorXd::Ones(size()));
    const double underflow =
        underflow_error<Scalar>() * root_area().norm() * root_area().cwiseInverse().norm();
    return rounding_certificate(rows.sums, rows.non_negative, reflectance(), root_area(),
                                {product_rounding<Scalar>(size()), underflow});
  }

 protected:
  void multiply_matrix(const ConstFieldRef& X, FieldRef Y) const override { multiply(matrix_, X, Y); }
  void multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const override {
    multiply_transposed(matrix_, X, Y);
  }

 private:
  RowGroups<Scalar> matrix_;
};

}  // namespace

std::unique_ptr<LinearOperator> make_csr_operator(Spec& spec, const FormFactors& form_factors) {
  const std::string storage = spec.choice("storage", "f64", {"f64", "f32"});
  spec.finish();
  if (storage == "f32") return make_stored<CsrKernelOperator, CsrMatrixOperator, float>(form_factors);
  return make_stored<CsrKernelOperator, CsrMatrixOperator, double>(form_factors);
}

}  // namespace radiosity
