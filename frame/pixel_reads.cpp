#include "frame/pixel_reads.hpp"

#include "foundation/error.hpp"

#include <epoxy/gl.h>
#include <utility>

namespace radiosity {
namespace {

constexpr std::size_t channels_of_pixel = 4;

}  // namespace

PixelReads::PixelReads(std::shared_ptr<const GlContext> context, int width, int height, int frames)
    : context_(std::move(context)),
      width_(width),
      height_(height),
      fences_(static_cast<std::size_t>(frames), nullptr) {
  const std::size_t bytes =
      channels_of_pixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (int frame = 0; frame < frames; ++frame) {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers_.emplace_back(context_, glGenBuffers, glDeleteBuffers).get());
    glBufferData(GL_PIXEL_PACK_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  context_->check("making room for the pixels of frames");
}

PixelReads::~PixelReads() {
  context_->when_current([this] {
    for (void* fence : fences_)
      if (fence != nullptr) glDeleteSync(static_cast<GLsync>(fence));
  });
}

void PixelReads::start(int frame) {
  const auto slot = static_cast<std::size_t>(frame);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers_[slot].get());
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void PixelReads::fence(int frame) {
  fences_[static_cast<std::size_t>(frame)] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
}

void PixelReads::finish(int frame, std::vector<std::uint8_t>& bytes) {
  const auto slot = static_cast<std::size_t>(frame);
  constexpr GLuint64 a_minute = 60'000'000'000;
  const auto fence = static_cast<GLsync>(std::exchange(fences_[slot], nullptr));
  const GLenum state = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, a_minute);
  glDeleteSync(fence);
  if (state == GL_TIMEOUT_EXPIRED || state == GL_WAIT_FAILED)
    fail("a frame is not done after a minute: '{}' does not answer", context_->renderer());

  const auto row = static_cast<std::size_t>(width_);
  const auto rows = static_cast<std::size_t>(height_);
  bytes.resize(3 * row * rows);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers_[slot].get());
  const auto* pixels = static_cast<const std::uint8_t*>(glMapBufferRange(
      GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(channels_of_pixel * row * rows), GL_MAP_READ_BIT));
  if (pixels == nullptr) context_->check("reading the pixels of a frame");
  for (std::size_t y = 0; pixels != nullptr && y < rows; ++y) {
    const std::uint8_t* from = pixels + channels_of_pixel * row * (rows - 1 - y);  // OpenGL's begin below
    std::uint8_t* to = bytes.data() + 3 * row * y;
    for (std::size_t x = 0; x < row; ++x)
      for (std::size_t c = 0; c < 3; ++c) to[3 * x + c] = from[channels_of_pixel * x + c];
  }
  glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

}  // namespace radiosity
