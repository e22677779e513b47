#include "frame/light_propagation.hpp"

#include "foundation/error.hpp"
#include "frame/direct_light.hpp"
#include "frame/emission_points.hpp"
#include "frame/patch_colour.hpp"
#include "frame/pixel_loop.hpp"
#include "frame/virtual_lights.hpp"
#include "render/bounding_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

constexpr int most_strata_of_surface = 64;

/// So many that what a point stands for is at most half a cell wide, for patches that are not slivers.
int strata_of_surface(const PatchMesh& mesh, double cell) {
  const double largest = std::sqrt(mesh.area.maxCoeff());
  return std::clamp(static_cast<int>(std::ceil(2 * largest / cell)), 1, most_strata_of_surface);
}

void add_surfaces(const PatchMesh& mesh, LightVolume& volume) {
  const EmissionPoints points = emission_points(mesh, strata_of_surface(mesh, volume.cell()));
  for (Index k = 0; k < points.position.cols(); ++k)
    volume.add_surface(points.position.col(k), points.normal.col(k),
                       mesh.area[k / points.per_patch] / static_cast<double>(points.per_patch));
}

}  // namespace

LightPropagation::LightPropagation(const PatchMesh& mesh, const PatchRays& rays,
                                   const LightPropagationOptions& options)
    : mesh_(mesh), rays_(rays), options_(options), volume_(bounding_box(mesh), options.cells) {
  if (options.steps < 0)
    fail<UsageError>("light cannot propagate {} steps from cell to cell; take 0 or more", options.steps);
  if (!mesh.emission.isZero(0))
    fail<UsageError>("light propagation follows the light of a frame's lights only; leave emitters dark");
  add_surfaces(mesh, volume_);
}

Picture LightPropagation::draw(const std::vector<FrameLight>& lights, const Camera& camera,
                               Monitor& monitor) {
  constexpr int one_reflection = 1;
  volume_.darken();
  for (const VirtualLight& light :
       virtual_lights(mesh_, rays_, lights, options_.lights, options_.seed, one_reflection))
    volume_.add_light(light.at.point, mesh_.normal.col(light.at.patch), light.flux);
  volume_.propagate(options_.steps);
  const DirectLight direct(mesh_, rays_, lights);
  return draw_pixels(
      rays_, camera, options_.width, options_.height, "light propagation", monitor,
      [&](const PatchHit& at) -> Color {
        return colour_of(mesh_.reflectance, at.patch) / std::numbers::pi *
               (direct.irradiance(at) + volume_.irradiance(at.point, mesh_.normal.col(at.patch)));
      });
}

}  // namespace radiosity
