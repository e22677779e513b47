#pragma once

#include "gpu/csr_on_device.hpp"
#include "gpu/device_matrix.hpp"
#include "gpu/stored_rows.hpp"
#include "kernels/quantized_tiles.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiosity {

/// Matrices in tiles of BC4 blocks on the device, one a channel, not symmetric: blocks are decoded in the
/// shader. What is kept apart stands in place of a texel; it is a sparse matrix of the differences here.
/// Column j of a field belongs to channel j mod channels.
class Bc4OnDevice final : public DeviceMatrix {
 public:
  /// Whether tiles are of that kind: BC4, with every tile of the matrix.
  static bool takes(const QuantizedTiles& tiles);

  /// One element a channel. Throws Error where a row of tiles does not fit into a storage block, or the
  /// matrices not into the device.
  Bc4OnDevice(std::shared_ptr<GlDevice> device, const std::vector<QuantizedTiles>& channels,
              RowStrategy strategy);

  ByteCount bytes() const override;
  double scale() const override { return scale_; }

 protected:
  void dispatch(Index columns) const override;

 private:
  struct Channel {
    std::uint32_t scale_bits;  ///< of float: its scale as a part of scale()
    StoredRows tile_rows;
    std::unique_ptr<CsrOnDevice> exact;
  };
  StoredRows upload_blocks(const QuantizedTiles& tiles) const;
  void dispatch_part(const Channel& channel, const StoredRows::Part& part, Index first_column, Index step,
                     Index columns) const;

  RowStrategy strategy_;
  double scale_ = 1;
  TileCurve curve_;
  ShaderFamily shaders_;
  std::vector<Channel> channels_;
};

}  // namespace radiosity
