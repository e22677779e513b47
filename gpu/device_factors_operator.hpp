#pragma once

#include "gpu/device_operator.hpp"
#include "gpu/factors_on_device.hpp"
#include "gpu/hybrid_factors.hpp"
#include "operators/low_rank_operator.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace radiosity {

/// R U V', for solvers that ask for factors (Woodbury). Factors: FactorsOnDevice or HybridFactors.
template <typename Factors>
class MatrixFactorsOperator : public DeviceMatrixOperator, public LowRankFactors {
 public:
  MatrixFactorsOperator(const MatrixOperator& original, std::unique_ptr<Factors> factors, DeviceOrigin origin)
      : DeviceMatrixOperator(original, std::move(factors), std::move(origin)),
        factors_(static_cast<const Factors*>(&matrix())) {}

  Index rank() const override { return factors_->rank(); }
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override { factors_->multiply_left(C, Y); }
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const override {
    factors_->multiply_right_transposed(X, C);
  }
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }
  std::size_t right_bytes() const override { return factors_->right_bytes(); }

 private:
  const Factors* factors_;  ///< the matrix of the operator
};

/// With both factors on the device.
using DeviceFactorsOperator = MatrixFactorsOperator<FactorsOnDevice>;

/// With U on the device and V on the CPU.
class HybridFactorsOperator final : public MatrixFactorsOperator<HybridFactors> {
 public:
  using MatrixFactorsOperator::MatrixFactorsOperator;

  /// None: fields have to come to the CPU for V'.
  std::optional<ResidentProduct> resident_product() const override { return std::nullopt; }
};

/// The same as the first for a symmetric kernel: R A^{-1/2} U V' A^{1/2}.
class DeviceKernelFactorsOperator final : public DeviceKernelOperator, public LowRankFactors {
 public:
  DeviceKernelFactorsOperator(const KernelOperator& original, std::unique_ptr<FactorsOnDevice> factors,
                              DeviceOrigin origin);

  Index rank() const override { return factors_->rank(); }
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const override;
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const override;
  const Eigen::MatrixXd& albedo() const override { return reflectance(); }
  std::size_t right_bytes() const override { return factors_->right_bytes(); }

 private:
  const FactorsOnDevice* factors_;  ///< the matrix of the operator
};

}  // namespace radiosity
