#include "frame/frame_target.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

int largest_side() {
  GLint texels = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &texels);
  return texels;
}

}  // namespace

void require_frame_size(int width, int height, int most) {
  if (width < 1 || height < 1 || std::max(width, height) > most)
    fail<UsageError>("a frame of {} x {} pixels is out of range; 1 to {} are possible each way", width,
                     height, most);
}

FrameTarget::FrameTarget(const std::shared_ptr<const GlContext>& context, int width, int height,
                         Numbers numbers)
    : width_(width),
      height_(height),
      colour_(context, glGenRenderbuffers, glDeleteRenderbuffers),
      depth_(context, glGenRenderbuffers, glDeleteRenderbuffers),
      framebuffer_(context, glGenFramebuffers, glDeleteFramebuffers) {
  require_frame_size(width, height, largest_side());
  glBindRenderbuffer(GL_RENDERBUFFER, colour_.get());
  glRenderbufferStorage(GL_RENDERBUFFER, numbers == Numbers::floats ? GL_RGBA32F : GL_SRGB8_ALPHA8, width,
                        height);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.get());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.get());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.get());
  context->check("making room for a frame's pixels");
}

void FrameTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, width_, height_);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);  // backs are looked through, as in render_picture
  glEnable(GL_FRAMEBUFFER_SRGB);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace radiosity
