#pragma once

#include "gpu/stored_rows.hpp"
#include "gpu/texels_on_device.hpp"
#include "kernels/colour_texture.hpp"
#include "kernels/exact_rows.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// Where BC1 blocks are on the device: in storage buffers, decoded by the shader, or in compressed textures,
/// decoded by the device's texture units (SampledTextureOnDevice).
enum class BlockPlacement { buffer, texture };

/// The entries that are added to a texture; their scale is above each of them and above the texture's scales.
KeptApart kept_apart_of(const ColourTexture& texture, const std::vector<ExactRows>& exact);

/// What a shader for BC1 blocks multiplies with at a time.
struct BlockRows {
  Index first;     ///< row of blocks of the matrix
  Index count;     ///< of such rows
  Index together;  ///< in a work group
  Index columns;   ///< blocks in a row
  Index y_stride;  ///< between columns of Y
};

/// Has it do so, for the columns of fields from `first_column` on, one a channel. The program is in use, its
/// own uniforms are set, and all it reads is bound.
void dispatch_block_rows(const GlProgram& program, const BlockRows& rows, Index first_column);

/// Document 000's compressed matrix on the device: BC1 blocks in a storage buffer, which the shader decodes
/// itself (texture units of different vendors round differently, and the software driver is slow at it), and
/// the entries that are kept apart.
class TextureOnDevice final : public TexelsOnDevice {
 public:
  /// `exact`: one a channel. Throws Error where a row of blocks does not fit into a storage block, or the
  /// matrix not into the device.
  TextureOnDevice(const std::shared_ptr<GlDevice>& device, const ColourTexture& texture,
                  const std::vector<ExactRows>& exact, RowStrategy strategy);

 protected:
  void dispatch_texels(Index columns) const override;
  std::size_t texel_bytes() const override;

 private:
  TextureOnDevice(const std::shared_ptr<GlDevice>& device, const ColourTexture& texture,
                  const KeptApart& kept_apart, RowStrategy strategy);
  void upload_tables(const ColourTexture& texture);
  void dispatch_part(const StoredRows::Part& part, Index first_column) const;

  Index block_columns_;
  const GlProgram* program_ = nullptr;  ///< the device's
  StoredRows blocks_;                   ///< a row for four of the matrix
  GlBuffer tables_;  ///< of ColourTexture, and the part that each channel's scale is of scale()
  std::shared_ptr<const GlBuffer> palettes_;  ///< of logarithmic textures, read as texels
};

}  // namespace radiosity
