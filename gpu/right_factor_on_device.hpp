#pragma once

#include "operators/linear_operator.hpp"

#include <cstddef>

namespace radiosity {

/// V' of a matrix U V' on the device, from fields of n rows to coefficients of k, which lie as fields do.
class RightFactorOnDevice {
 public:
  /// Where coefficients are written.
  static constexpr unsigned coefficients_binding = 4;

  virtual ~RightFactorOnDevice() = default;
  /// Whether fields and coefficients are in double precision.
  virtual bool in_double() const = 0;
  /// V' is this times what is stored.
  virtual double scale() const = 0;
  /// What it takes besides U.
  virtual ByteCount bytes() const = 0;
  /// What a product reads.
  virtual std::size_t bytes_read() const { return bytes().total(); }

  /// C = V' X / scale() for k > 0, X bound to FieldBuffers' binding and C to coefficients_binding. The
  /// context is current, and a memory barrier comes before C is read.
  virtual void multiply(Index columns) const = 0;
};

}  // namespace radiosity
