#pragma once

#include "gpu/device_matrix.hpp"
#include "gpu/right_factor_on_device.hpp"
#include "gpu/tall_on_device.hpp"

#include <cstddef>
#include <memory>
#include <string>

namespace radiosity {

/// U V' on the device, by its factors, in double or float32. A product leaves its k coefficients there; each
/// factor can be multiplied with alone.
class FactorsOnDevice : public DeviceMatrix {
 public:
  /// Both in the same precision; `left_name`: what bytes() calls U.
  FactorsOnDevice(std::shared_ptr<GlDevice> device, std::string left_name,
                  std::shared_ptr<const TallOnDevice> U, std::shared_ptr<const RightFactorOnDevice> V);

  Index rank() const { return left_->columns(); }
  bool in_double() const final { return left_->in_double(); }
  double scale() const final { return left_scale() * right_scale(); }
  ByteCount bytes() const override;

  /// Y = U C, n x c from k x c, and C = V' X, k x c from n x c, for c > 0 columns.
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const;
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const;
  /// What the latter reads.
  std::size_t right_bytes() const { return right_->bytes_read(); }
  /// U and V' are these times what is stored.
  double left_scale() const { return left_->scale(); }
  double right_scale() const { return right_->scale(); }

  /// The same two for fields that are on the device, in the precision of the factors, without these scales;
  /// the coefficients of the second stay there. The context is current.
  void multiply_left_on_device(const GlBuffer& C, const GlBuffer& Y, Index columns) const;
  void sum_on_device(const GlBuffer& X, Index columns) const;

 protected:
  ByteCount left_bytes() const { return {{{left_name_, left_->bytes()}}}; }
  void dispatch(Index columns) const final;

 private:
  /// From the field that is bound as X, to coefficients.
  GlBuffer& dispatch_sums(Index columns) const;

  std::string left_name_;
  std::shared_ptr<const TallOnDevice> left_;
  std::shared_ptr<const RightFactorOnDevice> right_;
  mutable GrowingBuffer coefficients_;
};

}  // namespace radiosity
