#include "frame/instant_radiosity.hpp"

#include "foundation/error.hpp"
#include "frame/direct_light.hpp"
#include "frame/patch_colour.hpp"
#include "frame/pixel_loop.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace radiosity {
namespace {

/// What virtual lights send to points of patches.
class VirtualLighting {
 public:
  VirtualLighting(const PatchMesh& mesh, const PatchRays& rays, std::vector<VirtualLight> lights,
                  double closest)
      : mesh_(mesh), rays_(rays), lights_(std::move(lights)), least_square_(closest * closest) {}

  /// W/m^2.
  Color irradiance(const PatchHit& at) const {
    Color sum = Color::Zero();
    for (const VirtualLight& light : lights_) {
      const Vector3 way = light.at.point - at.point;
      const double here = way.dot(mesh_.normal.col(at.patch));
      const double there = -way.dot(mesh_.normal.col(light.at.patch));
      if (here <= 0 || there <= 0 || rays_.blocked(at.patch, at.point, light.at.patch, light.at.point))
        continue;
      const double square = way.squaredNorm();
      sum += here * there / (square * std::max(square, least_square_) * std::numbers::pi) * light.flux;
    }
    return sum;
  }

  std::size_t size() const { return lights_.size(); }

 private:
  const PatchMesh& mesh_;
  const PatchRays& rays_;
  std::vector<VirtualLight> lights_;
  double least_square_;
};

void check(const PatchMesh& mesh, const InstantRadiosityOptions& options) {
  if (!(options.closest >= 0))
    fail<UsageError>("the closest that a virtual light may be is {}; it must not be negative",
                     options.closest);
  if (!mesh.emission.isZero(0))
    fail<UsageError>("instant radiosity follows the light of a frame's lights only; leave emitters dark");
}

}  // namespace

InstantRadiosityFrame instant_radiosity(const PatchMesh& mesh, const PatchRays& rays,
                                        const std::vector<FrameLight>& lights, const Camera& camera,
                                        const InstantRadiosityOptions& options, Monitor& monitor) {
  check(mesh, options);
  const DirectLight direct(mesh, rays, lights);
  const VirtualLighting indirect(
      mesh, rays, virtual_lights(mesh, rays, lights, options.paths, options.seed, options.reflections),
      options.closest);
  Picture picture = draw_pixels(rays, camera, options.width, options.height, "instant radiosity", monitor,
                                [&](const PatchHit& at) -> Color {
                                  return colour_of(mesh.reflectance, at.patch) / std::numbers::pi *
                                         (direct.irradiance(at) + indirect.irradiance(at));
                                });
  return {std::move(picture), indirect.size()};
}

}  // namespace radiosity
