#pragma once

#include "frame/frame_light.hpp"
#include "render/patch_rays.hpp"

#include <vector>

namespace radiosity {

/// What points of patches receive straight from the lights of a frame, with one ray to each light and no
/// shadow map. Refers to what it is made of, which outlives it. Safe from several threads.
class DirectLight {
 public:
  DirectLight(const PatchMesh& mesh, const PatchRays& rays, const std::vector<FrameLight>& lights)
      : mesh_(mesh), rays_(rays), lights_(lights) {}

  /// Whether nothing is between a point and the place of a light.
  bool visible(const PatchHit& at, const Vector3& light) const;

  /// W/m^2.
  Color irradiance(const PatchHit& at) const;

 private:
  const PatchMesh& mesh_;
  const PatchRays& rays_;
  const std::vector<FrameLight>& lights_;
};

}  // namespace radiosity
