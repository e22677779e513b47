#pragma once

#include "gpu/factors_on_device.hpp"
#include "kernels/segments.hpp"

#include <memory>

namespace radiosity {

/// U V' on the device where V has one number a row (document 004, section 4). Scalar: double or float.
class SparseVOnDevice final : public FactorsOnDevice {
 public:
  /// U: n x k, its rows in the sorted order of V.
  template <typename Scalar>
  SparseVOnDevice(const std::shared_ptr<GlDevice>& device, const TallMatrix<Scalar>& U, const Segments& V,
                  RowStrategy strategy);

 private:
  template <typename Scalar>
  SparseVOnDevice(const std::shared_ptr<GlDevice>& device, const TallMatrix<Scalar>& U, const Segments& V,
                  const std::shared_ptr<const GlBuffer>& order, RowStrategy strategy);
};

}  // namespace radiosity
