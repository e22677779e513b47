#pragma once

#include "gpu/device_field.hpp"
#include "gpu/factors_on_device.hpp"

namespace radiosity {

/// Frames of document 004's Algorithm 2 on a device, which keeps E and B: X = V' E, then B = E - Y X, with Y
/// and V as the factors of a low-rank matrix. Calls return when the device knows what to do: receive() waits
/// for it. The context is current in every call.
class LowRankFrame {
 public:
  /// `factors` outlive it. Throws UsageError where they are in double precision, and Error where fields of so
  /// many columns do not fit.
  LowRankFrame(const FactorsOnDevice& factors, Index columns);

  /// E, n x c.
  void send(const ConstFieldRef& emission);
  /// X alone.
  void sum() const;
  /// B.
  void compute() const;
  /// B from an X that is computed elsewhere, k x c: what is left of a frame that is shared with the CPU.
  void compute_with(const ConstFieldRef& X);
  /// B, n x c.
  void receive(FieldRef radiosity) const;

 private:
  void subtract(double scale) const;

  const FactorsOnDevice& factors_;
  double unit_ = 1;  ///< of fields on the device
  DeviceField emission_;
  DeviceField product_;
  DeviceField radiosity_;
  DeviceField coefficients_;
  const GlProgram* subtraction_;  ///< the device's
};

}  // namespace radiosity
