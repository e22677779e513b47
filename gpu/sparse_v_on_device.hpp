#pragma once

#include "gpu/factors_on_device.hpp"
#include "gpu/tall_on_device.hpp"
#include "kernels/segments.hpp"

#include <optional>

namespace radiosity {

/// U V' on the device where V has one number a row (document 004, section 4): V' X is k sums over segments of
/// the rows sorted by patch, one to a work group or an invocation.
class SparseVOnDevice final : public FactorsOnDevice {
 public:
  /// U: n x k, its rows in the sorted order of V.
  SparseVOnDevice(std::shared_ptr<GlDevice> device, const TallMatrix<float>& U, const Segments& V,
                  RowStrategy strategy);

  ByteCount bytes() const override;
  std::size_t right_bytes() const override;
  double left_scale() const override { return left_.scale(); }
  double right_scale() const override { return weight_scale_; }

 protected:
  void dispatch_left(Index columns) const override;
  void dispatch_right(Index columns) const override;

 private:
  TallOnDevice left_;
  GlBuffer offsets_;
  std::optional<GlBuffer> order_;    ///< empty: rows are sorted already
  std::optional<GlBuffer> weights_;  ///< empty: all 1
  double weight_scale_ = 1;
  Index lanes_;  ///< that share a segment
  ShaderFamily segment_sums_;
};

}  // namespace radiosity
