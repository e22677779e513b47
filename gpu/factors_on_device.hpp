#pragma once

#include "gpu/device_matrix.hpp"

#include <cstddef>

namespace radiosity {

/// U V' on the device, by its factors. A product leaves its k coefficients there; each factor can be
/// multiplied with alone.
class FactorsOnDevice : public DeviceMatrix {
 public:
  Index rank() const { return rank_; }
  double scale() const final { return left_scale() * right_scale(); }

  /// Y = U C, n x c from k x c, and C = V' X, k x c from n x c, for c > 0 columns.
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const;
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const;
  /// What the latter reads.
  virtual std::size_t right_bytes() const = 0;
  /// U and V' are these times what is stored.
  virtual double left_scale() const = 0;
  virtual double right_scale() const = 0;

  /// The same two for fields that are on the device, without these scales; the coefficients of the second
  /// stay there. The context is current.
  void multiply_left_on_device(const GlBuffer& C, const GlBuffer& Y, Index columns) const;
  void sum_on_device(const GlBuffer& X, Index columns) const;

 protected:
  /// Where V' X is written.
  static constexpr unsigned coefficients_binding = 4;

  FactorsOnDevice(std::shared_ptr<GlDevice> device, Index n, Index rank)
      : DeviceMatrix(std::move(device), n, n), rank_(rank) {}

  /// From coefficients, bound as X, to a field, bound as Y; without left_scale().
  virtual void dispatch_left(Index columns) const = 0;
  /// From a field, bound as X, to coefficients, bound to coefficients_binding, columns padded as those of
  /// fields are; k > 0; without right_scale().
  virtual void dispatch_right(Index columns) const = 0;

  void dispatch(Index columns) const final;

 private:
  /// From the field that is bound as X, to coefficients.
  GlBuffer& dispatch_sums(Index columns) const;

  Index rank_;
  mutable GrowingBuffer coefficients_;
};

}  // namespace radiosity
