#pragma once

#include "frame/frame_light.hpp"

#include <array>
#include <vector>

namespace radiosity {

/// Lights that a frame may have.
constexpr int most_frame_lights = 4;
/// Layers of the shadow maps of a point light: a cube's faces.
constexpr int cube_layers = 6;
constexpr int most_layers = most_frame_lights * cube_layers;

/// How many layers a light of that kind takes.
constexpr int layers_of(FrameLightKind kind) {
  return kind == FrameLightKind::point ? cube_layers : 1;
}

/// What changes from frame to frame, as the uniform block of gpu/shaders/frame_block.glsl has it (std140).
/// Positions are about the origin of the frame's scene.
struct FrameBlock {
  using Four = std::array<float, 4>;
  struct LightOfBlock {
    Four position;
    Four intensity;  ///< W/sr; then 1 for spots, 0 for points
    Four axis;       ///< unit vector; the cosine at which a spot ends
    Four map;        ///< the cosine from which on it shines in full, its first layer
  };
  /// Of a map: what is seen lies within +- extent of forward along right and up.
  struct Face {
    Four right;
    Four up;
    Four forward;  ///< and the extent
  };
  std::array<float, 16> view_projection;  ///< by columns
  Four scalars;  ///< exposure, nearest depth of shadow maps, lights, texels of a side
  std::array<LightOfBlock, most_frame_lights> lights;
  std::array<Face, most_layers> faces;
};

/// How shadow maps are made.
struct ShadowMapping {
  int size = 1024;     ///< texels of a side
  double nearest = 0;  ///< what is nearer to a light than this throws no shadow, scene units
};

/// Sets the lights and faces of a block, and all scalars but the exposure. Throws UsageError for more lights
/// than a frame may have, and spots that are at their target or too wide.
void set_lights(FrameBlock& block, const std::vector<FrameLight>& lights, const Vector3& origin,
                const ShadowMapping& mapping);

/// Sets the camera: width / height is `aspect`, and what is drawn lies in a ball about the origin. Throws
/// Error for a camera without a direction.
void set_camera(FrameBlock& block, const Camera& camera, double aspect, const Vector3& origin, double radius);

}  // namespace radiosity
