#include "gpu/device_factors_operator.hpp"

#include <utility>

namespace radiosity {

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
