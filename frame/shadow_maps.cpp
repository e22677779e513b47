#include "frame/shadow_maps.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

std::vector<ShaderVariant> shadow_stages(int layers) {
  return {{"shadow.vert", {}}, {"shadow.geom", {{"LAYERS", layers}}}, {"shadow.frag", {}}};
}

int require_map_size(int size) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (size < 4 || size > most)
    fail<UsageError>("shadow maps of {} x {} texels are out of range; 4 to {} are possible", size, size,
                     most);
  return size;
}

}  // namespace

ShadowMaps::ShadowMaps(const std::shared_ptr<const GlContext>& context, const Eigen::Matrix3Xf& triangles,
                       const std::vector<FrameLightKind>& lights, int size)
    : size_(require_map_size(size)),
      corners_(static_cast<int>(triangles.cols())),
      cube_program_(context, shadow_stages(cube_layers)),
      spot_program_(context, shadow_stages(1)),
      positions_(context,
                 std::max<std::size_t>(static_cast<std::size_t>(triangles.size()), 1) * sizeof(float)),
      vertices_(context, glGenVertexArrays, glDeleteVertexArrays),
      texture_(context, glGenTextures, glDeleteTextures),
      framebuffer_(context, glGenFramebuffers, glDeleteFramebuffers) {
  int layers = 0;
  for (const FrameLightKind kind : lights) {
    passes_.push_back(
        {kind == FrameLightKind::point ? &cube_program_ : &spot_program_, static_cast<int>(passes_.size())});
    layers += layers_of(kind);
  }
  if (triangles.size() > 0) positions_.write(0, positions_.bytes(), triangles.data());
  glBindVertexArray(vertices_.get());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);

  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.get());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH_COMPONENT32F, size_, size_, std::max(layers, 1));
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_.get(), 0);
  glDrawBuffer(GL_NONE);
  context->check("making shadow maps");
}

void ShadowMaps::render() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, size_, size_);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glBindVertexArray(vertices_.get());
  for (const Pass& pass : passes_) {
    pass.program->use();
    pass.program->set("light", pass.light);
    glDrawArrays(GL_TRIANGLES, 0, corners_);
  }
}

void ShadowMaps::bind() const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.get());
}

}  // namespace radiosity
