#pragma once

#include "gpu/device_matrix.hpp"
#include "gpu/tall_on_device.hpp"
#include "kernels/segments.hpp"

#include <memory>
#include <variant>

namespace radiosity {

/// U V' in two places (document 004's future work): V' X on the CPU, U C on the device. Of several columns
/// the CPU computes the coefficients of the next few while the device multiplies those of the last.
class HybridFactors final : public DeviceMatrix {
 public:
  /// V as all its numbers, or with one number a row; U has its rows in the sorted order of the latter.
  using RightFactor = std::variant<TallMatrix<float>, Segments>;

  HybridFactors(std::shared_ptr<GlDevice> device, const TallMatrix<float>& U, RightFactor V,
                RowStrategy strategy);

  Index rank() const { return left_.columns(); }
  void multiply(const ConstFieldRef& X, FieldRef Y) const override;
  /// Y = U C on the device, and C = V' X on the CPU.
  void multiply_left(const ConstFieldRef& C, FieldRef Y) const;
  void multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const;
  std::size_t right_bytes() const;

  /// With V's, which are the CPU's.
  ByteCount bytes() const override;
  double scale() const override { return left_.scale(); }

 protected:
  /// U alone.
  void dispatch(Index columns) const override;

 private:
  std::shared_ptr<const GlBuffer> order_;  ///< of rows; none: they are sorted already
  TallOnDevice left_;
  RightFactor right_;
};

}  // namespace radiosity
