#pragma once

#include "gpu/gl_buffer.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// A field that lives on the device in float32, laid out as FieldBuffers has it. The context is current in
/// every call.
class DeviceField {
 public:
  /// Zeros. Throws Error where it does not fit into a storage block, or not into the device.
  DeviceField(std::shared_ptr<const GlContext> context, Index rows, Index columns);

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  /// Between columns: rows, padded.
  Index stride() const;

  void clear();
  /// The first c <= columns() columns, from n x c, rounded to float32.
  void write(const ConstFieldRef& field);
  /// Waits for the device.
  Field read() const;

  const GlBuffer& buffer() const { return buffer_; }

 private:
  Index rows_;
  Index columns_;
  GlBuffer buffer_;
};

}  // namespace radiosity
