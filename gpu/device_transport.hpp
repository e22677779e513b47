#pragma once

#include "gpu/device_matrix.hpp"

#include <vector>

namespace radiosity {

/// T as a matrix on the device between diagonals: T = P' L M R P. M is `matrix`; column j of a field takes
/// columns j mod channels of L and R. Row p of P X is row order[p] of X; no order is the patches' own.
struct DeviceTransport {
  const DeviceMatrix* matrix;
  Eigen::ArrayXXd left;   ///< n x channels, by patch
  Eigen::ArrayXXd right;  ///< the same
  std::vector<Index> order = {};
};

}  // namespace radiosity
