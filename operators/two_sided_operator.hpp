#pragma once

#include "operators/element_partition.hpp"
#include "operators/low_rank_operator.hpp"

#include <string>

namespace radiosity {

/// T P + P T - P T P with P the area-weighted mean over each patch of a coarse mesh (methods.md, layers):
/// what it leaves out, (I - P) T (I - P), is what varies within patches on both ends. Symmetric: the kernel
/// is X W' + W X' - W (W'X) W' with X = K W, n x k, and W = indicators of the patches times A^{1/2}, columns
/// of length 1. One stored factor, rank 2k for Woodbury's formula. Scalar: double or float.
template <typename Scalar>
class TwoSidedOperator final : public KernelOperator, public LowRankFactors {
 public:
  /// X: n x k, rows in the order of the mesh.
  TwoSidedOperator(const FormFactors& form_factors, ElementPartition partition, const Eigen::MatrixXd& X,
                   std::string spec, std::string remark);

  /// Twice the number of patches: U = A^{-1/2} [X, W], V = A^{1/2} [W, X - W (W'X)].
  Index rank() const override { return 2 * X_.cols(); }
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override;
  void multiply_right_transposed(const ConstFieldRef& Y, FieldRef C) const override;
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }

  ByteCount bytes() const override;
  std::string describe() const override { return spec_; }
  std::string remark() const override { return remark_; }
  double product_roundoff() const override { return sizeof(Scalar) == 8 ? 0x1p-53 : 0x1p-24; }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  // W' Y for Y in the order of the mesh.
  Field patch_components(const ConstFieldRef& Y) const;
  // X C1 + W C2, in the order of the mesh.
  Field combine(const ConstFieldRef& C1, const ConstFieldRef& C2) const;

  InstructionSet instructions_ = best_instruction_set();
  ElementPartition partition_;
  FactorMatrix<Scalar> X_;          ///< n x k
  Eigen::MatrixXd patch_products_;  ///< W'X, k x k, symmetric
  Eigen::VectorXd indicator_;       ///< the entry of W in each row, n
  std::string spec_;
  std::string remark_;
};

}  // namespace radiosity
