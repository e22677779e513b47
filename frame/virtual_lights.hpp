#pragma once

#include "frame/frame_light.hpp"
#include "render/patch_rays.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace radiosity {

/// A point of a patch that stands for light that is reflected there (Keller 1997, "Instant Radiosity"). It
/// radiates as its surface does: flux / pi times the cosine, W/sr.
struct VirtualLight {
  PatchHit at;
  Color flux = Color::Zero();  ///< what leaves the point, W
};

constexpr int all_reflections = std::numeric_limits<int>::max();

/// Follows that many paths from each light through at most so many diffuse reflections, with a virtual light
/// wherever they are reflected; they end by Russian roulette, so that the virtual lights stand for all
/// bounces, without bias. First directions are spread evenly over what a light shines into. `rays` are of the
/// mesh. Throws UsageError for less than one path and for rho >= 1, where paths need not end.
std::vector<VirtualLight> virtual_lights(const PatchMesh& mesh, const PatchRays& rays,
                                         const std::vector<FrameLight>& lights, int paths, std::uint64_t seed,
                                         int reflections = all_reflections);

}  // namespace radiosity
