#pragma once

#include "frame/frame_block.hpp"
#include "gpu/gl_buffer.hpp"
#include "gpu/gl_name.hpp"
#include "gpu/gl_program.hpp"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace radiosity {

/// Depth as lights see it, one map for a spot and the six faces of a cube for a point, all layers of one
/// texture (gpu/shaders/direct_light.glsl reads them). Both sides of a triangle block. The context is current
/// in every call.
class ShadowMaps {
 public:
  /// `triangles`: 3 x corners about the frame's origin, three a triangle. Throws Error where the device has
  /// no room for most_layers maps of size x size, or not that large ones.
  ShadowMaps(const std::shared_ptr<const GlContext>& context, const Eigen::Matrix3Xf& triangles,
             const std::vector<FrameLightKind>& lights, int size);

  /// Renders all of them; the block that says where the lights are is bound as uniform block 0.
  void render() const;

  /// For the shaders that include direct_light.glsl.
  void bind() const;

 private:
  struct Pass {
    const GlProgram* program;
    int light;
  };

  int size_;
  int corners_;
  GlProgram cube_program_;
  GlProgram spot_program_;
  std::vector<Pass> passes_;
  GlBuffer positions_;
  GlName vertices_;
  GlName texture_;
  GlName framebuffer_;
};

}  // namespace radiosity
