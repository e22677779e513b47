#pragma once

#include "foundation/monitor.hpp"
#include "frame/frame_light.hpp"
#include "frame/virtual_lights.hpp"
#include "render/patch_rays.hpp"
#include "render/picture.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiosity {

struct InstantRadiosityOptions {
  int width = 1280;  ///< pixels
  int height = 720;
  int paths = 64;      ///< from each light
  double closest = 0;  ///< virtual lights nearer than this light as from there, scene units
  std::uint64_t seed = 1;
  int reflections = all_reflections;  ///< at most, of each path
};

struct InstantRadiosityFrame {
  Picture picture;  ///< radiance, W/(m^2 sr)
  std::size_t virtual_lights = 0;
};

/// A frame whose indirect light is that of virtual lights (Keller 1997), on the CPU: in the middle of each
/// pixel direct light exactly and a shadow ray to every virtual light. 1 / d^2 is at most 1 / closest^2.
/// With closest = 0 the mean over seeds is the light of all bounces, but each virtual light burns a bright
/// spot into what is near to it; with more, light is lost near edges, whatever the number of paths. `rays`
/// are of the mesh. The result depends on the seed but not on the number of threads. Throws UsageError for
/// options out of range, for meshes with emission of their own, and as virtual_lights() does.
InstantRadiosityFrame instant_radiosity(const PatchMesh& mesh, const PatchRays& rays,
                                        const std::vector<FrameLight>& lights, const Camera& camera,
                                        const InstantRadiosityOptions& options, Monitor& monitor);

}  // namespace radiosity
