#pragma once

#include "gpu/device_operator.hpp"
#include "operators/colour_operator.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// Document 000's R M C^-1, or E + R M C^-1 E where global (operators/colour_operator.hpp), with M on the
/// device.
class DeviceColourOperator : public DeviceOperator<LinearOperator> {
 public:
  Index size() const override { return reflectance_.rows(); }
  Index channels() const override { return reflectance_.cols(); }
  bool global() const override { return global_; }

 protected:
  DeviceColourOperator(const ColourOperator& original, Matrices matrices, DeviceOrigin origin);

  /// Y = M X, c > 0; Y is written, never read.
  virtual void multiply_colours(const ConstFieldRef& X, FieldRef Y) const = 0;

  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override;

  /// Without parts and order.
  ResidentProduct resident_diagonals() const;

 private:
  Eigen::MatrixXd reflectance_;
  Eigen::ArrayXXd inverse_colours_;  ///< 1 / c, n x channels
  bool global_;
};

/// With a full matrix for each distinct reflectance.
class DeviceBouncesOperator final : public DeviceColourOperator {
 public:
  DeviceBouncesOperator(const ColourOperator& original, Matrices sums, DeviceOrigin origin);

  std::optional<ResidentProduct> resident_product() const override;

 protected:
  void multiply_colours(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  DistinctReflectances reflectances_;
};

/// With a compressed matrix of all channels, whose rows and columns have an order of their own.
class DeviceTextureOperator final : public DeviceColourOperator {
 public:
  /// order[p]: the patch at place p.
  DeviceTextureOperator(const ColourOperator& original, std::unique_ptr<DeviceMatrix> texture,
                        std::vector<Index> order, DeviceOrigin origin);

  std::optional<ResidentProduct> resident_product() const override;

 protected:
  void multiply_colours(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  std::vector<Index> order_;
};

}  // namespace radiosity
