#pragma once

#include "gpu/gl_name.hpp"
#include "kernels/colour_texture.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace radiosity {

/// The BC1 blocks of a matrix in compressed textures of the device, bit by bit as they are, in as many as its
/// largest texture asks for. A row of blocks that is longer than a texture is wide goes on in the texture's
/// next row of blocks.
class BlockTextures {
 public:
  struct Part {
    Index first_row;  ///< of blocks of the matrix
    Index rows;
    std::unique_ptr<const GlName> texture;
  };

  /// Throws Error where the device has no such textures (GL_EXT_texture_compression_s3tc), or no room for
  /// them. The context is current.
  BlockTextures(const std::shared_ptr<const GlContext>& context, const ColourTexture& texture);

  const std::vector<Part>& parts() const { return parts_; }
  /// Blocks in a row of a texture.
  Index blocks_across() const { return blocks_across_; }
  std::size_t bytes() const { return bytes_; }

 private:
  void send_row(const Part& part, Index row, const Bc1Block* blocks, Index count) const;

  Index blocks_across_;
  Index texture_rows_;  ///< of a texture, for each row of blocks
  std::size_t bytes_;
  std::vector<Part> parts_;
};

}  // namespace radiosity
