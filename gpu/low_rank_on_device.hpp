#pragma once

#include "gpu/factors_on_device.hpp"
#include "gpu/tall_on_device.hpp"
#include "kernels/tall_matrix.hpp"

#include <optional>

namespace radiosity {

/// U V' or Q diag(values) Q' on the device, in float32.
class LowRankOnDevice final : public FactorsOnDevice {
 public:
  /// F = U V'.
  LowRankOnDevice(std::shared_ptr<GlDevice> device, const TallMatrix<float>& U, const TallMatrix<float>& V,
                  RowStrategy strategy);
  /// K = Q diag(values) Q', as U = Q and V = Q diag(values).
  LowRankOnDevice(std::shared_ptr<GlDevice> device, const TallMatrix<float>& Q, const Eigen::VectorXd& values,
                  RowStrategy strategy);

  ByteCount bytes() const override;
  std::size_t right_bytes() const override { return right().bytes(); }
  double left_scale() const override { return left_.scale(); }
  double right_scale() const override { return right().scale() * values_scale_; }

 protected:
  void dispatch_left(Index columns) const override { left_.multiply(columns); }
  void dispatch_right(Index columns) const override;

 private:
  const TallOnDevice& right() const { return right_ ? *right_ : left_; }

  TallOnDevice left_;
  std::optional<TallOnDevice> right_;  ///< the left one where it is empty
  std::optional<GlBuffer> values_;
  double values_scale_ = 1;
  mutable const GlProgram* sum_chunks_ = nullptr;  ///< the device's
  mutable GrowingBuffer sums_;                     ///< over chunks of rows
};

}  // namespace radiosity
