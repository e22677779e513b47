#pragma once

#include "form_factors/form_factors.hpp"
#include "kernels/segments.hpp"
#include "operators/low_rank_operator.hpp"

#include <string>
#include <vector>

namespace radiosity {

/// T = R U V' where V has one number a row (document 004, section 4): U in the order of the elements sorted
/// by patch, V as k + 1 offsets into that order and, where the elements of a patch differ in area, their n
/// areas. V' X is k sums. Fields come and go in the order of the mesh; who keeps them sorted uses the _sorted
/// functions and saves the permutation. Scalar: double or float.
template <typename Scalar>
class SparseVOperator final : public MatrixOperator, public LowRankFactors {
 public:
  /// `V`: ElementPartition::right_factor(); `U`: n x k, its rows in the sorted order of V. `form_factors` may
  /// lack F: areas and reflectances are taken from its mesh.
  SparseVOperator(const FormFactors& form_factors, Segments V, FactorMatrix<Scalar> U, std::string spec,
                  std::string remark);

  const FactorMatrix<Scalar>& left_factor() const { return U_; }
  const Segments& right_factor() const { return V_; }

  Index rank() const override { return U_.columns(); }
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override;
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const override;
  /// In one pass over U for each.
  std::vector<Eigen::MatrixXd> multiply_between(const ConstFieldRef& diagonals) const override;
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }
  std::size_t right_bytes() const override {
    return V_.offset_bytes() + V_.order_bytes() + V_.weight_bytes();
  }

  /// Y = U C, and C = V' X, for fields sorted by patch.
  void multiply_left_sorted(const ConstFieldRef& C, FieldRef Y) const;
  void multiply_right_transposed_sorted(const ConstFieldRef& X, FieldRef C) const;

  ByteCount bytes() const override;
  std::string describe() const override { return spec_; }
  std::string remark() const override { return remark_; }
  double product_roundoff() const override { return sizeof(Scalar) == 8 ? 0x1p-53 : 0x1p-24; }

 protected:
  void multiply_matrix(const ConstFieldRef& X, FieldRef Y) const override;
  void multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  InstructionSet instructions_ = best_instruction_set();
  Segments V_;
  FactorMatrix<Scalar> U_;
  std::string spec_;
  std::string remark_;
};

}  // namespace radiosity
