#include "gpu/texel_units.hpp"

#include "foundation/error.hpp"

#include <epoxy/gl.h>

namespace radiosity {
namespace {

struct TexelFormat {
  GLenum name;
  int bytes;
};

TexelFormat format_of(Texel texel) {
  switch (texel) {
    case Texel::one_float:
      return {GL_R32F, 4};
    case Texel::four_floats:
      return {GL_RGBA32F, 16};
    case Texel::four_shorts:
      return {GL_RGBA16UI, 8};
    case Texel::four_words:
      break;
  }
  return {GL_RGBA32UI, 16};
}

}  // namespace

TexelUnits::~TexelUnits() {
  context_->when_current(
      [this] { glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data()); });
}

void TexelUnits::show(unsigned unit, Texel texel, const GlBuffer& buffer) {
  show_range(unit, texel, buffer.name(), 0, static_cast<std::int64_t>(buffer.bytes()));
}

void TexelUnits::show_bound(unsigned unit, Texel texel, unsigned binding) {
  GLint buffer = 0;
  GLint64 offset = 0;
  GLint64 bytes = 0;
  glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &buffer);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, binding, &offset);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, binding, &bytes);
  if (bytes == 0) {  // bound as a whole
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(buffer));
    glGetBufferParameteri64v(GL_SHADER_STORAGE_BUFFER, GL_BUFFER_SIZE, &bytes);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  show_range(unit, texel, static_cast<unsigned>(buffer), offset, bytes);
}

void TexelUnits::show_range(unsigned unit, Texel texel, unsigned buffer, std::int64_t offset,
                            std::int64_t bytes) {
  if (most_texels_ == 0) glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most_texels_);
  const TexelFormat format = format_of(texel);
  if (bytes / format.bytes > most_texels_)
    fail("a buffer has {} texels, and '{}' reads at most {}: use strategy=group or fewer patches",
         bytes / format.bytes, context_->renderer(), most_texels_);
  glActiveTexture(GL_TEXTURE0 + unit);
  if (textures_[unit] == 0) {
    glGenTextures(1, &textures_[unit]);
    glBindTexture(GL_TEXTURE_BUFFER, textures_[unit]);  // for good: there are no others of this kind
  }
  glTexBufferRange(GL_TEXTURE_BUFFER, format.name, buffer, offset, bytes);
}

}  // namespace radiosity
