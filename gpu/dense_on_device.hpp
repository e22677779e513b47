#pragma once

#include "gpu/csr_on_device.hpp"
#include "gpu/device_matrix.hpp"
#include "gpu/shader_family.hpp"
#include "gpu/stored_rows.hpp"
#include "kernels/half.hpp"
#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <memory>
#include <type_traits>

namespace radiosity {

/// Every entry of a matrix on the device, by rows padded to a multiple of 64 numbers, in double, float32 or
/// binary16.
/// A symmetric kernel is stored in full, both halves and its zero tiles: twice the memory, but every product
/// reads each row as one stream and needs no atomic sums. Rows are split over as many storage blocks as the
/// driver's limit asks for. Subnormal numbers of binary16, which drivers may take for zero, are kept apart.
template <typename Scalar>
class DenseOnDevice final : public DeviceMatrix {
 public:
  /// Copies the matrix. Throws Error where 64 rows do not fit into a storage block, or the matrix not into
  /// the device.
  DenseOnDevice(std::shared_ptr<GlDevice> device, const SymmetricTiles<Scalar>& kernel, RowStrategy strategy);
  DenseOnDevice(std::shared_ptr<GlDevice> device, const RowMajorMatrix<Scalar>& matrix, RowStrategy strategy);

  ByteCount bytes() const override;
  double scale() const override { return scale_; }
  bool in_double() const override { return std::is_same_v<Scalar, double>; }
  /// Over how many storage blocks it is split.
  std::size_t blocks() const { return strips_.parts().size(); }

 protected:
  void dispatch(Index columns) const override;

 private:
  template <typename ReadStrip>
  StoredRows upload(const ReadStrip& read_strip);

  Index stride_;
  double scale_;
  RowStrategy strategy_;
  std::unique_ptr<CsrOnDevice<float>> subnormal_ = nullptr;  ///< null if there is none
  StoredRows strips_;                                        ///< of 64 rows each, padding included
  ShaderFamily shaders_;
};

extern template class DenseOnDevice<double>;
extern template class DenseOnDevice<float>;
extern template class DenseOnDevice<Half>;

}  // namespace radiosity
