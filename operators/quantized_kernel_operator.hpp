#pragma once

#include "kernels/quantized_tiles.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/stored_matrix.hpp"

namespace radiosity {

/// A kernel in quantized tiles as an operator: what `quantized` and `topk` share. Its certificate is proved
/// while it is made, entry by entry against the true kernel.
class QuantizedKernelOperator final : public KernelOperator, public HasCompressedKernel {
 public:
  /// `tiles` approximates form_factors.kernel; `spec` is what describe() gives.
  QuantizedKernelOperator(const FormFactors& form_factors, QuantizedTiles tiles, std::string spec);

  ByteCount bytes() const override;
  std::string describe() const override { return spec_; }
  Certificate certificate() const override { return certificate_; }
  double product_roundoff() const override { return 0x1p-24; }
  const QuantizedTiles& compressed_kernel() const override { return tiles_; }
  const std::vector<Index>& kernel_order() const override { return order_; }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    multiply(tiles_, X, Y, instructions_);
  }

 private:
  InstructionSet instructions_ = best_instruction_set();
  QuantizedTiles tiles_;
  std::vector<Index> order_;  ///< the patches' own: empty
  std::string spec_;
  Certificate certificate_;
};

/// Throws UsageError, naming the operator, unless form factors have a symmetric kernel.
void require_symmetric_kernel(const FormFactors& form_factors, const std::string& operator_name);

}  // namespace radiosity
