#pragma once

#include "gpu/device_matrix.hpp"

#include <Eigen/Core>

#include <numeric>
#include <vector>

namespace radiosity {

/// The irradiance that an operator on the device gives, in parts that can be multiplied with there:
/// H = after M (before B), component by component and channel by channel, with the rows of M in an order of
/// their own. T B = R H; where the operator is global, H is that of all its bounces from B = E alone.
struct ResidentProduct {
  struct Part {
    const DeviceMatrix* matrix;   ///< the operator's
    std::vector<Index> channels;  ///< that it multiplies
  };
  std::vector<Part> parts;      ///< every channel in one of them
  Eigen::MatrixXd before;       ///< n x channels
  Eigen::MatrixXd after;        ///< the same
  Eigen::MatrixXd reflectance;  ///< the same
  std::vector<Index> order;     ///< the patch at each place of M; empty: patches in their own order
  bool global = false;
};

inline std::vector<Index> every_channel(Index channels) {
  std::vector<Index> all(static_cast<std::size_t>(channels));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

}  // namespace radiosity
