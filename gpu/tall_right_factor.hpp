#pragma once

#include "gpu/field_buffers.hpp"
#include "gpu/right_factor_on_device.hpp"
#include "gpu/tall_on_device.hpp"

#include <memory>
#include <optional>

namespace radiosity {

/// V' on the device with all numbers of V.
class TallRightFactor final : public RightFactorOnDevice {
 public:
  TallRightFactor(std::shared_ptr<GlDevice> device, std::shared_ptr<const TallOnDevice> V);
  /// V = Q diag(values), Q being the left factor as well.
  TallRightFactor(std::shared_ptr<GlDevice> device, std::shared_ptr<const TallOnDevice> Q,
                  const Eigen::VectorXd& values);

  bool in_double() const override { return matrix_->in_double(); }
  double scale() const override { return matrix_->scale() * values_scale_; }
  ByteCount bytes() const override;
  std::size_t bytes_read() const override { return matrix_->bytes() + (values_ ? values_->bytes() : 0); }
  void multiply(Index columns) const override;

 private:
  template <typename Number>
  void upload_values(const Eigen::VectorXd& values);

  std::shared_ptr<GlDevice> device_;
  std::shared_ptr<const TallOnDevice> matrix_;  ///< V or Q
  std::optional<GlBuffer> values_;
  double values_scale_ = 1;
  mutable const GlProgram* sum_chunks_ = nullptr;  ///< the device's
  mutable GrowingBuffer sums_;                     ///< over chunks of rows
};

}  // namespace radiosity
