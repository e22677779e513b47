#pragma once

#include "foundation/monitor.hpp"
#include "foundation/parallel.hpp"
#include "render/camera_rays.hpp"
#include "render/patch_rays.hpp"
#include "render/picture.hpp"

#include <atomic>
#include <cstddef>

namespace radiosity {

/// A picture with the radiance of what is first seen in the middle of each pixel, `radiance(hit)`, which is
/// called from several threads; black where nothing is.
template <typename Radiance>
Picture draw_pixels(const PatchRays& rays, const Camera& camera, int width, int height, const char* what,
                    Monitor& monitor, const Radiance& radiance) {
  const CameraRays camera_rays(camera, width, height);
  Picture picture{width, height, {}};
  picture.pixels.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::atomic<int> done{0};
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const PatchHit at = rays.first_front(camera_rays.origin(), camera_rays.direction(x + 0.5, y + 0.5));
      if (at.missed()) continue;
      const Color seen = radiance(at);
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = static_cast<float>(seen[c]);
    }
    monitor.checkpoint(what, static_cast<double>(++done) / height);
  });
  return picture;
}

}  // namespace radiosity
