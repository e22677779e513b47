#pragma once

#include "gpu/field_buffers.hpp"
#include "gpu/right_factor_on_device.hpp"
#include "gpu/shader_family.hpp"
#include "kernels/segments.hpp"

#include <memory>
#include <optional>

namespace radiosity {

/// The row at each sorted position, in 32 bits; nothing where rows are sorted already. Throws Error where it
/// takes more than a storage block.
std::shared_ptr<const GlBuffer> order_on_device(const std::shared_ptr<GlDevice>& device, const Segments& V);

/// V' on the device where V has one number a row (document 004, section 4): k sums over segments of the rows
/// sorted by patch, one to a work group or an invocation.
class SegmentsOnDevice final : public RightFactorOnDevice {
 public:
  /// `order`: order_on_device() of V. Throws Error where a list takes more than a storage block.
  SegmentsOnDevice(std::shared_ptr<GlDevice> device, const Segments& V, std::shared_ptr<const GlBuffer> order,
                   RowStrategy strategy, bool in_double);

  bool in_double() const override { return in_double_; }
  double scale() const override { return weight_scale_; }
  ByteCount bytes() const override;
  void multiply(Index columns) const override;

 private:
  template <typename Number>
  void upload_weights(const std::vector<double>& weights);

  std::shared_ptr<GlDevice> device_;
  Index rows_;
  Index count_;
  bool in_double_;
  GlBuffer offsets_;
  std::shared_ptr<const GlBuffer> order_;
  std::optional<GlBuffer> weights_;  ///< empty: all 1
  double weight_scale_ = 1;
  Index lanes_;  ///< that share a segment
  ShaderFamily segment_sums_;
};

}  // namespace radiosity
