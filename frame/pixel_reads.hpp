#pragma once

#include "gpu/gl_name.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace radiosity {

/// Pixels of frames on their way back: copied by the device into buffers, and taken from them once it has
/// done so, a frame or more later, so that neither waits for the other. The context is current in every call
/// but the destructor's.
class PixelReads {
 public:
  /// For `frames` frames at a time.
  PixelReads(std::shared_ptr<const GlContext> context, int width, int height, int frames);
  ~PixelReads();
  PixelReads(const PixelReads&) = delete;
  PixelReads& operator=(const PixelReads&) = delete;

  /// Has the device copy what was drawn into the bound framebuffer.
  void start(int frame);
  /// Marks what has been asked for so far, the copy at least: finish() waits for it.
  void fence(int frame);
  /// Waits until it has and gives 3 x width x height bytes, rows from the top.
  void finish(int frame, std::vector<std::uint8_t>& bytes);

 private:
  std::shared_ptr<const GlContext> context_;
  int width_;
  int height_;
  std::deque<GlName> buffers_;
  std::vector<void*> fences_;  ///< GLsync; null where nothing is on its way
};

}  // namespace radiosity
