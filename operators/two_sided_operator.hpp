#pragma once

#include "kernels/segments.hpp"
#include "operators/low_rank_operator.hpp"

#include <string>

namespace radiosity {

/// T P + P T - P T P with P the area-weighted mean over each patch of a coarse mesh (methods.md, layers):
/// what it leaves out, (I - P) T (I - P), is what varies within patches on both ends. Symmetric: with W =
/// indicators of the patches times A^{1/2}, columns of length 1, and X = K W the kernel is X W' + W X' - W
/// (W'X) W' = Z W' + W Z', Z = X - 1/2 W (W'X): one stored factor of n x k. Scalar: double or float.
template <typename Scalar>
class TwoSidedOperator final : public KernelOperator, public LowRankFactors {
 public:
  /// W: ElementPartition::orthonormal_indicators(); X = K W: n x k, rows in the order of the mesh.
  TwoSidedOperator(const FormFactors& form_factors, Segments W, const Eigen::MatrixXd& X, std::string spec,
                   std::string remark);

  /// Twice the number of patches: U = A^{-1/2} [Z, W], V = A^{1/2} [W, Z].
  Index rank() const override { return 2 * Z_.columns(); }
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override;
  void multiply_right_transposed(const ConstFieldRef& Y, FieldRef C) const override;
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }
  std::size_t right_bytes() const override;
  /// Z and W.
  const FactorMatrix<Scalar>& factor() const { return Z_; }
  const Segments& indicators() const { return W_; }

  ByteCount bytes() const override;
  std::string describe() const override { return spec_; }
  std::string remark() const override { return remark_; }
  double product_roundoff() const override { return sizeof(Scalar) == 8 ? 0x1p-53 : 0x1p-24; }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  std::size_t indicator_bytes() const;
  // W' Y and Z' Y.
  Field components(const ConstFieldRef& Y) const;
  // Z C1 + W C2 for C = [C1; C2].
  Field combine(const ConstFieldRef& C) const;

  InstructionSet instructions_ = best_instruction_set();
  Segments W_;
  FactorMatrix<Scalar> Z_;
  std::string spec_;
  std::string remark_;
};

}  // namespace radiosity
