#include "gpu/device_factors_operator.hpp"

#include <utility>

namespace radiosity {

DeviceFactorsOperator::DeviceFactorsOperator(const MatrixOperator& original,
                                             std::unique_ptr<FactorsOnDevice> factors, DeviceOrigin origin)
    : DeviceMatrixOperator(original, std::move(factors), std::move(origin)),
      factors_(static_cast<const FactorsOnDevice*>(&matrix())) {}

HybridFactorsOperator::HybridFactorsOperator(const MatrixOperator& original,
                                             std::unique_ptr<HybridFactors> factors, DeviceOrigin origin)
    : DeviceMatrixOperator(original, std::move(factors), std::move(origin)),
      factors_(static_cast<const HybridFactors*>(&matrix())) {}

DeviceKernelFactorsOperator::DeviceKernelFactorsOperator(const KernelOperator& original,
                                                         std::unique_ptr<FactorsOnDevice> factors,
                                                         DeviceOrigin origin)
    : DeviceKernelOperator(original, std::move(factors), std::move(origin)),
      factors_(static_cast<const FactorsOnDevice*>(&matrix())) {}

void DeviceKernelFactorsOperator::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  factors_->multiply_left(C, Y);
  Y = root_area().cwiseInverse().asDiagonal() * Y;
}

void DeviceKernelFactorsOperator::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  const Field scaled = root_area().asDiagonal() * X;
  factors_->multiply_right_transposed(scaled, C);
}

}  // namespace radiosity
