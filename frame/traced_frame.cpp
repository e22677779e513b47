#include "frame/traced_frame.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "frame/direct_light.hpp"
#include "frame/patch_colour.hpp"
#include "render/camera_rays.hpp"
#include "render/patch_rays.hpp"
#include "render/path_sampling.hpp"

#include <algorithm>
#include <atomic>
#include <numbers>

namespace radiosity {
namespace {

/// Of a pixel, W/(m^2 sr).
struct TracedPixel {
  Color radiance = Color::Zero();
  Color standard_error = Color::Zero();
};

class FrameTracer {
 public:
  FrameTracer(const PatchMesh& mesh, const std::vector<FrameLight>& lights)
      : mesh_(mesh), rays_(mesh), direct_(mesh, rays_, lights) {}

  /// From `samples` paths.
  TracedPixel radiance(const Vector3& origin, const Vector3& direction, int samples,
                       RandomStream& random) const {
    const PatchHit hit = rays_.first_front(origin, direction);
    if (hit.missed()) return {};
    Color sum = Color::Zero();
    Color squares = Color::Zero();
    for (int sample = 0; sample < samples; ++sample) {
      const Color indirect = gathered(hit, random);
      sum += indirect;
      squares += indirect.square();
    }
    const Color reflected = colour_of(mesh_.reflectance, hit.patch) / std::numbers::pi;
    const Color own = colour_of(mesh_.emission, hit.patch) / std::numbers::pi;
    const Color variance = (squares - sum.square() / samples).max(0) / std::max(samples - 1, 1) / samples;
    return {own + reflected * (direct_.irradiance(hit) + sum / samples), reflected * variance.sqrt()};
  }

 private:
  /// Irradiance from one direction, cosine-weighted: B of what is there, by a path that ends by Russian
  /// roulette.
  Color gathered(PatchHit at, RandomStream& random) const {
    Color sum = Color::Zero();
    Color throughput = Color::Ones();
    for (;;) {
      const double u = random.uniform();
      const double v = random.uniform();
      at = rays_.from_patch(at.patch, at.point, cosine_direction(mesh_.normal.col(at.patch), u, v));
      if (at.missed() || !at.front) return sum;
      sum += throughput * colour_of(mesh_.emission, at.patch);
      throughput *= colour_of(mesh_.reflectance, at.patch);
      sum += throughput * direct_.irradiance(at);
      const double survival = std::min(1.0, throughput.maxCoeff());
      if (random.uniform() >= survival) return sum;
      throughput /= survival;
    }
  }

  const PatchMesh& mesh_;
  PatchRays rays_;
  DirectLight direct_;
};

void check(const PatchMesh& mesh, const TracedFrameOptions& options) {
  if (options.samples < 1)
    fail<UsageError>("{} paths from a pixel are too few; at least one is needed", options.samples);
  for (Index i = 0; i < mesh.patch_count(); ++i)
    if (!(mesh.reflectance.row(i).maxCoeff() < 1))
      fail<UsageError>(
          "patch {} has reflectance {}: paths between such patches need not end; limit it below 1", i,
          mesh.reflectance.row(i).maxCoeff());
}

}  // namespace

TracedFrame trace_frame(const PatchMesh& mesh, const std::vector<FrameLight>& lights, const Camera& camera,
                        const TracedFrameOptions& options, Monitor& monitor) {
  check(mesh, options);
  const CameraRays camera_rays(camera, options.width, options.height);
  const FrameTracer tracer(mesh, lights);
  const auto width = static_cast<std::size_t>(options.width);
  Picture black{options.width, options.height, {}};
  black.pixels.resize(3 * width * static_cast<std::size_t>(options.height));
  TracedFrame frame{black, black};
  std::atomic<int> done{0};
  parallel_for(static_cast<std::size_t>(options.height), [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < options.width; ++x) {
      RandomStream random(options.seed, row * width + static_cast<std::size_t>(x));
      const TracedPixel found = tracer.radiance(camera_rays.origin(), camera_rays.direction(x + 0.5, y + 0.5),
                                                options.samples, random);
      for (int c = 0; c < 3; ++c) {
        frame.picture.pixel(x, y)[c] = static_cast<float>(found.radiance[c]);
        frame.standard_error.pixel(x, y)[c] = static_cast<float>(found.standard_error[c]);
      }
    }
    monitor.checkpoint("path tracing", static_cast<double>(++done) / options.height);
  });
  return frame;
}

}  // namespace radiosity
