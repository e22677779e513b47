#pragma once

#include "gpu/csr_on_device.hpp"
#include "gpu/device_matrix.hpp"
#include "gpu/stored_rows.hpp"
#include "kernels/colour_texture.hpp"
#include "kernels/exact_rows.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace radiosity {

/// Document 000's compressed matrix on the device: BC1 blocks in a storage buffer, which the shader decodes
/// itself (texture units of different vendors round differently, and the software driver is slow at it), and
/// the entries that are kept apart, a sparse matrix a channel. Column j of a field belongs to channel j mod
/// channels.
class TextureOnDevice final : public DeviceMatrix {
 public:
  /// `exact`: one a channel. Throws Error where a row of blocks does not fit into a storage block, or the
  /// matrix not into the device.
  TextureOnDevice(std::shared_ptr<GlDevice> device, const ColourTexture& texture,
                  const std::vector<ExactRows>& exact, RowStrategy strategy);

  ByteCount bytes() const override;
  double scale() const override { return scale_; }

 protected:
  void dispatch(Index columns) const override;

 private:
  void upload_tables(const ColourTexture& texture);
  void upload_palettes(const ColourTexture& texture);
  void dispatch_part(const StoredRows::Part& part, Index first_column) const;

  Index channels_;
  Index block_columns_;
  double scale_;
  RowStrategy strategy_;
  const GlProgram* program_ = nullptr;  ///< the device's
  StoredRows blocks_;                   ///< a row for four of the matrix
  GlBuffer tables_;  ///< of ColourTexture, and the part that each channel's scale is of scale()
  std::optional<GlBuffer> palettes_;  ///< of logarithmic textures, read as texels
  std::vector<std::unique_ptr<CsrOnDevice>> exact_;
};

}  // namespace radiosity
