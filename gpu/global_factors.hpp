#pragma once

#include "gpu/device_matrix.hpp"
#include "operators/global_operator.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// What a product with a global operator of low rank, B = E + Y V' D E, takes on a device.
struct GlobalFactors {
  std::vector<std::unique_ptr<DeviceMatrix>> products;  ///< Y V', one a distinct reflectance, with one V
  Eigen::VectorXd before;                               ///< D: A^{1/2} for symmetric kernels, else 1
};

/// In the precision of Y: V is widened where Y is kept in float64 for its condition. No products where the
/// operator's V has no form for the device. Throws Error where the device has no room for them.
GlobalFactors global_factors_on_device(const std::shared_ptr<GlDevice>& device, const GlobalOperator& global,
                                       RowStrategy strategy);

}  // namespace radiosity
