#include "gpu/block_textures.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <utility>

namespace radiosity {
namespace {

constexpr Index side = ColourTexture::block_side;

std::unique_ptr<const GlName> empty_texture(const std::shared_ptr<const GlContext>& context, Index across,
                                            Index down) {
  auto texture = std::make_unique<const GlName>(context, glGenTextures, glDeleteTextures);
  glBindTexture(GL_TEXTURE_2D, texture->get());
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, static_cast<GLsizei>(side * across),
                 static_cast<GLsizei>(side * down));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  context->check(fmt::format("a texture of {} x {} blocks", across, down));
  return texture;
}

void require_block_textures(const GlContext& context) {
  if (!epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc"))
    fail("'{}' has no textures of BC1 blocks (GL_EXT_texture_compression_s3tc): take blocks=buffer",
         context.renderer());
}

}  // namespace

BlockTextures::BlockTextures(const std::shared_ptr<const GlContext>& context, const ColourTexture& texture)
    : blocks_across_(std::min(texture.block_columns(), context->limits().texture_side / side)),
      texture_rows_(blocks_across_ == 0 ? 1
                                        : (texture.block_columns() + blocks_across_ - 1) / blocks_across_),
      bytes_(0) {
  require_block_textures(*context);
  const Index most = context->limits().texture_side / side / texture_rows_;
  if (most == 0)
    fail("a row of {} blocks is more than a texture of '{}' holds: use --device cpu", texture.block_columns(),
         context->renderer());
  for (Index first = 0; first < texture.block_rows(); first += most) {
    const Index rows = std::min(most, texture.block_rows() - first);
    parts_.push_back({first, rows, empty_texture(context, blocks_across_, rows * texture_rows_)});
    for (Index row = 0; row < rows; ++row)
      send_row(parts_.back(), row, texture.block_row(first + row), texture.block_columns());
    bytes_ += static_cast<std::size_t>(rows * texture_rows_ * blocks_across_) * sizeof(Bc1Block);
    context->count_sent(static_cast<std::size_t>(rows * texture.block_columns()) * sizeof(Bc1Block));
  }
  context->check("sending blocks of a texture");
}

void BlockTextures::send_row(const Part& part, Index row, const Bc1Block* blocks, Index count) const {
  glBindTexture(GL_TEXTURE_2D, part.texture->get());
  for (Index first = 0; first < count; first += blocks_across_) {
    const Index together = std::min(blocks_across_, count - first);
    const Index texture_row = row * texture_rows_ + first / blocks_across_;
    glCompressedTexSubImage2D(
        GL_TEXTURE_2D, 0, 0, static_cast<GLint>(side * texture_row), static_cast<GLsizei>(side * together),
        static_cast<GLsizei>(side), GL_COMPRESSED_RGB_S3TC_DXT1_EXT,
        static_cast<GLsizei>(together * static_cast<Index>(sizeof(Bc1Block))), blocks + first);
  }
}

}  // namespace radiosity
