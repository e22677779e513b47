#pragma once

#include "gpu/device_operator.hpp"
#include "operators/distinct_reflectances.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// E -> B = E + S D E with S D = G - I: matrices S on the device, one a distinct reflectance, and a diagonal
/// D.
class DeviceSeriesOperator final : public DeviceOperator<LinearOperator> {
 public:
  /// `series`: in the order of DistinctReflectances; `reflectance`: n x channels; `before`: D, n numbers.
  DeviceSeriesOperator(const Eigen::MatrixXd& reflectance, std::vector<std::unique_ptr<DeviceMatrix>> series,
                       Eigen::VectorXd before, DeviceOrigin origin);

  Index size() const override { return reflectance_.rows(); }
  Index channels() const override { return reflectance_.cols(); }
  bool global() const override { return true; }
  std::optional<ResidentProduct> resident_product() const override;

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override;

 private:
  Eigen::MatrixXd reflectance_;
  DistinctReflectances reflectances_;
  Eigen::VectorXd before_;
};

}  // namespace radiosity
