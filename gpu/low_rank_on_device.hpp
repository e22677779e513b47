#pragma once

#include "gpu/factors_on_device.hpp"
#include "kernels/tall_matrix.hpp"

#include <memory>

namespace radiosity {

/// U V' or Q diag(values) Q' on the device, with all numbers of the factors. Scalar: double or float.
class LowRankOnDevice final : public FactorsOnDevice {
 public:
  /// F = U V'.
  template <typename Scalar>
  LowRankOnDevice(const std::shared_ptr<GlDevice>& device, const TallMatrix<Scalar>& U,
                  const TallMatrix<Scalar>& V, RowStrategy strategy);
  /// K = Q diag(values) Q', as U = Q and V = Q diag(values).
  template <typename Scalar>
  LowRankOnDevice(const std::shared_ptr<GlDevice>& device, const TallMatrix<Scalar>& Q,
                  const Eigen::VectorXd& values, RowStrategy strategy);

 private:
  LowRankOnDevice(const std::shared_ptr<GlDevice>& device, const std::shared_ptr<const TallOnDevice>& Q,
                  const Eigen::VectorXd& values);
};

}  // namespace radiosity
