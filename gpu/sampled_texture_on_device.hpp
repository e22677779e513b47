#pragma once

#include "gpu/block_textures.hpp"
#include "gpu/texels_on_device.hpp"
#include "kernels/exact_rows.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// Document 000's compressed matrix on the device as the document has it there (Section 3.5): BC1 blocks in
/// compressed textures, from which the device's texture units take the codes; the shader puts them on the
/// curve. The codes between the two of a block are interpolated before the curve then. So are ours: with
/// logarithms, A^2 B of the cube roots of two numbers is what the code (2 a + b) / 3 stands for, and A^3 what
/// a does (kernels/colour_texture.hpp), so that both placements give the same numbers, but for what texture
/// units round: gpu/sampling_difference.hpp bounds it.
class SampledTextureOnDevice final : public TexelsOnDevice {
 public:
  /// `exact`: one a channel. Throws Error where the device has no such textures, or no room for the matrix.
  SampledTextureOnDevice(const std::shared_ptr<GlDevice>& device, const ColourTexture& texture,
                         const std::vector<ExactRows>& exact, RowStrategy strategy);

 protected:
  void dispatch_texels(Index columns) const override;
  std::size_t texel_bytes() const override { return curve_.bytes() + textures_.bytes(); }

 private:
  void dispatch_part(const BlockTextures::Part& part, Index first_column) const;

  Index block_columns_;
  BlockTextures textures_;
  GlBuffer curve_;            ///< its range, and the part that each channel's scale is of scale()
  const GlProgram* program_;  ///< the device's
};

}  // namespace radiosity
