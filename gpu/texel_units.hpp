#pragma once

#include "gpu/gl_buffer.hpp"

#include <array>
#include <memory>

namespace radiosity {

/// What a texture of a buffer has for a texel.
enum class Texel { one_float, four_floats, four_shorts, four_words };

/// Buffers that shaders read as buffer textures. Software renderers get them so: Mesa's llvmpipe loads from
/// storage blocks number by number and lane by lane, and fetches texels for all lanes at once. The memory of
/// a buffer that is deleted stays until its unit shows another. The context is current in every call but the
/// destructor's.
class TexelUnits {
 public:
  explicit TexelUnits(std::shared_ptr<const GlContext> context) : context_(std::move(context)) {}
  ~TexelUnits();
  TexelUnits(const TexelUnits&) = delete;
  TexelUnits& operator=(const TexelUnits&) = delete;

  /// `buffer` is what the shaders' texture unit `unit` (0, 1 or 2) reads, until the next of that unit.
  /// Throws Error where it has more texels than the driver reads.
  void show(unsigned unit, Texel texel, const GlBuffer& buffer);
  /// The same for what is bound as storage block `binding`, when the shaders before have written it.
  void show_bound(unsigned unit, Texel texel, unsigned binding);

 private:
  void show_range(unsigned unit, Texel texel, unsigned buffer, std::int64_t offset, std::int64_t bytes);

  std::shared_ptr<const GlContext> context_;
  std::array<unsigned, 3> textures_{};  ///< OpenGL's, a unit each
  int most_texels_ = 0;                 ///< 0: not asked yet
};

}  // namespace radiosity
