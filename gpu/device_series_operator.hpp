#pragma once

#include "gpu/device_operator.hpp"
#include "operators/distinct_reflectances.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// E -> B = E + S E with S = G - I on the device, one a distinct reflectance.
class DeviceSeriesOperator final : public DeviceOperator<LinearOperator> {
 public:
  /// `series`: in the order of DistinctReflectances; `reflectance`: n x channels.
  DeviceSeriesOperator(const Eigen::MatrixXd& reflectance, std::vector<std::unique_ptr<DeviceMatrix>> series,
                       DeviceOrigin origin);

  Index size() const override { return reflectance_.rows(); }
  Index channels() const override { return reflectance_.cols(); }
  bool global() const override { return true; }
  std::optional<ResidentProduct> resident_product() const override;

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override;

 private:
  Eigen::MatrixXd reflectance_;
  DistinctReflectances reflectances_;
};

}  // namespace radiosity
