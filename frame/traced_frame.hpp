#pragma once

#include "foundation/monitor.hpp"
#include "frame/frame_light.hpp"
#include "render/picture.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

struct TracedFrameOptions {
  int width = 1280;  ///< pixels
  int height = 720;
  int samples = 64;  ///< paths from each pixel
  std::uint64_t seed = 1;
};

struct TracedFrame {
  Picture picture;         ///< radiance, W/(m^2 sr)
  Picture standard_error;  ///< of each pixel, the same; 0 where there is a single path
};

/// The frame as path tracing has it (document 000, section 4.3), the referee of FrameRenderer: radiance at
/// the middle of each pixel, direct light exactly, the rest by paths that take direct light wherever they are
/// reflected and the emission of the fronts that they hit. No form factors, patches or maps are in it. Camera
/// rays look through backs. The result does not depend on the number of threads. Throws UsageError for
/// options out of range and for rho >= 1.
TracedFrame trace_frame(const PatchMesh& mesh, const std::vector<FrameLight>& lights, const Camera& camera,
                        const TracedFrameOptions& options, Monitor& monitor);

}  // namespace radiosity
