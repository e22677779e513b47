#pragma once

#include "foundation/monitor.hpp"
#include "frame/frame_light.hpp"
#include "frame/light_volume.hpp"
#include "render/patch_rays.hpp"
#include "render/picture.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

struct LightPropagationOptions {
  int width = 1280;  ///< pixels
  int height = 720;
  int cells = 32;     ///< along the longest edge of the scene
  int steps = 64;     ///< from cell to neighbour
  int lights = 4096;  ///< points that stand for what each light shines on (the paper's reflective shadow map)
  std::uint64_t seed = 1;
};

/// Frames whose indirect light comes from a light propagation volume (frame/light_volume.hpp), on the CPU:
/// the first reflection is put into the grid and spread there; in the middle of each pixel direct light
/// exactly. As published it has one reflection, soft, and leaks through what is thinner than a cell. Surfaces
/// are put into the grid once. Refers to the mesh and its rays, which outlive it. Results depend on the seed
/// but not on the number of threads.
class LightPropagation {
 public:
  /// Throws UsageError for options out of range and for meshes with emission of their own.
  LightPropagation(const PatchMesh& mesh, const PatchRays& rays, const LightPropagationOptions& options);

  /// Radiance, W/(m^2 sr).
  Picture draw(const std::vector<FrameLight>& lights, const Camera& camera, Monitor& monitor);

  const LightVolume& volume() const { return volume_; }

 private:
  const PatchMesh& mesh_;
  const PatchRays& rays_;
  LightPropagationOptions options_;
  LightVolume volume_;
};

}  // namespace radiosity
