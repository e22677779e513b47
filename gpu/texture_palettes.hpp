#pragma once

#include "gpu/gl_buffer.hpp"
#include "kernels/colour_texture.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace radiosity {

/// The palettes of logarithmic textures on a device: four numbers for each pair of codes of a colour channel.
/// They depend on the curve alone, so that textures of one curve share them, as long as there is one.
class TexturePalettes {
 public:
  explicit TexturePalettes(std::shared_ptr<const GlContext> context) : context_(std::move(context)) {}

  /// For a logarithmic texture, by second code and then by first, one colour channel after the other. The
  /// context is current.
  std::shared_ptr<const GlBuffer> of(const ColourTexture& texture);

 private:
  struct Known {
    double range;
    int channels;
    std::weak_ptr<const GlBuffer> palettes;
  };

  std::shared_ptr<const GlContext> context_;
  std::vector<Known> known_;
};

}  // namespace radiosity
