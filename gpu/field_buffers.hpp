#pragma once

#include "gpu/gl_buffer.hpp"
#include "kernels/products.hpp"

#include <memory>
#include <tuple>
#include <vector>

namespace radiosity {

/// Where fields are on the device, for one product after the other: X (read by shaders as storage block 1)
/// and Y (written, block 2), in numbers that are float or, for matrices of double precision, double. Columns
/// lie one after the other, each padded with zeros to a multiple of 64 numbers. Each column of X is divided
/// by a power of two that brings its largest number near 1, so that in float only what is 2^-126 of it can
/// underflow; Y is multiplied by it again.
class FieldBuffers {
 public:
  static constexpr Index padding = 64;
  static constexpr Index x_binding = 1;
  static constexpr Index y_binding = 2;
  static Index padded(Index rows) { return (rows + padding - 1) / padding * padding; }

  explicit FieldBuffers(std::shared_ptr<const GlContext> context) : context_(std::move(context)) {}

  /// Sends X, makes room for a Y of `y_rows` rows and as many columns, and binds both. The context is
  /// current.
  template <typename Number>
  void send(const ConstFieldRef& X, Index y_rows);
  /// Makes the Y that was sent for another storage block as well.
  void bind_y(unsigned binding) const { y_in_use_->bind(binding); }
  /// Waits for the device and gives `scale` times what it wrote.
  template <typename Number>
  void receive(double scale, FieldRef Y);

 private:
  std::shared_ptr<const GlContext> context_;
  GrowingBuffer x_;
  GrowingBuffer y_;
  GlBuffer* y_in_use_ = nullptr;
  std::tuple<std::vector<float>, std::vector<double>> numbers_;  ///< on their way
  std::vector<double> column_scale_;                             ///< of X
};

}  // namespace radiosity
