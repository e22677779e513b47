#pragma once

#include "kernels/tall_matrix.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/matrix_operator.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// How U and V are kept.
template <typename Scalar>
using FactorMatrix = TallMatrix<Scalar>;

/// The side interface of operators T = R U V' with U and V of n x k: what Woodbury's formula needs.
class LowRankFactors {
 public:
  virtual ~LowRankFactors() = default;
  virtual Index rank() const = 0;
  /// Y = U C, n x c from k x c.
  virtual void multiply_left(const ConstFieldRef& C, FieldRef Y) const = 0;
  /// C = V' X, k x c from n x c.
  virtual void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const = 0;
  /// V' diag(d) U, k x k, for each column d of `diagonals` (n x c): k products with U and V, some columns at
  /// a time, unless there is a shorter way.
  virtual std::vector<Eigen::MatrixXd> multiply_between(const ConstFieldRef& diagonals) const;
  /// R, n x channels.
  virtual const Eigen::MatrixXd& albedo() const = 0;
  /// What multiply_right_transposed reads.
  virtual std::size_t right_bytes() const = 0;
};

/// T = R U V' with U and V of n x k (document 004): 2 n k multiplications a column. U and V know nothing of
/// reflectances, so that one pair serves every colour. Scalar: double or float.
template <typename Scalar>
class LowRankOperator final : public MatrixOperator, public LowRankFactors {
 public:
  /// U V' approximates F of `form_factors`; `spec` is what describe() gives.
  LowRankOperator(const FormFactors& form_factors, const Eigen::MatrixXd& U, const Eigen::MatrixXd& V,
                  std::string spec, std::string remark = {});

  Index rank() const override { return U_.columns(); }
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override { multiply(U_, C, Y, instructions_); }
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const override {
    multiply_transposed(V_, X, C, instructions_);
  }
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }
  std::size_t right_bytes() const override { return V_.entry_bytes(); }
  const FactorMatrix<Scalar>& left_factor() const { return U_; }
  const FactorMatrix<Scalar>& right_factor() const { return V_; }

  ByteCount bytes() const override;
  std::string describe() const override { return spec_; }
  std::string remark() const override { return remark_; }
  double product_roundoff() const override { return sizeof(Scalar) == 8 ? 0x1p-53 : 0x1p-24; }

 protected:
  void multiply_matrix(const ConstFieldRef& X, FieldRef Y) const override;
  void multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  InstructionSet instructions_ = best_instruction_set();
  FactorMatrix<Scalar> U_;
  FactorMatrix<Scalar> V_;
  std::string spec_;
  std::string remark_;
};

/// T = R A^{-1/2} Q diag(values) Q' A^{1/2}: low rank in the area norm, where K is symmetric and one factor
/// of n x k suffices.
template <typename Scalar>
class LowRankKernelOperator final : public KernelOperator, public LowRankFactors {
 public:
  /// Q: n x k, orthonormal columns; `error` bounds ||K - Q diag(values) Q'||_2 if it is known.
  LowRankKernelOperator(const FormFactors& form_factors, const Eigen::MatrixXd& Q,
                        const Eigen::VectorXd& values, std::optional<double> error, std::string spec);

  Index rank() const override { return Q_.columns(); }
  /// U = A^{-1/2} Q diag(values), V = A^{1/2} Q.
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override;
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const override;
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }
  std::size_t right_bytes() const override {
    return Q_.entry_bytes() + static_cast<std::size_t>(size()) * sizeof(double);
  }
  /// Q and the values.
  const FactorMatrix<Scalar>& factor() const { return Q_; }
  const Eigen::VectorXd& values() const { return values_; }
  ByteCount bytes() const override;
  std::string describe() const override { return spec_; }
  Certificate certificate() const override { return certificate_; }
  double product_roundoff() const override { return sizeof(Scalar) == 8 ? 0x1p-53 : 0x1p-24; }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  InstructionSet instructions_ = best_instruction_set();
  FactorMatrix<Scalar> Q_;
  Eigen::VectorXd values_;
  std::string spec_;
  Certificate certificate_;
};

}  // namespace radiosity
