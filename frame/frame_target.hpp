#pragma once

#include "gpu/gl_name.hpp"

#include <memory>

namespace radiosity {

/// What a frame is drawn into. The context is current in every call.
class FrameTarget {
 public:
  enum class Numbers {
    srgb_bytes,  ///< what is drawn is encoded as sRGB, 8 bits a channel
    floats       ///< as it is
  };

  /// Throws UsageError for more pixels than the device can draw.
  FrameTarget(const std::shared_ptr<const GlContext>& context, int width, int height, Numbers numbers);

  /// Binds and clears it: black, nothing drawn.
  void begin() const;

 private:
  int width_;
  int height_;
  GlName colour_, depth_, framebuffer_;
};

/// Throws UsageError for sizes that a picture cannot have; most: of the device.
void require_frame_size(int width, int height, int most);

}  // namespace radiosity
