#include "frame/virtual_lights.hpp"

#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "frame/direct_light.hpp"
#include "frame/patch_colour.hpp"
#include "render/path_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

/// The lattice of Fibonacci on a cap of the sphere: point k of so many, evenly by solid angle, turned by
/// `turn` (a part of the circle).
Vector3 direction_in_cap(const Vector3& axis, double end_cosine, int k, int count, double turn) {
  const double cosine = 1 - (k + 0.5) / count * (1 - end_cosine);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double angle = 2 * std::numbers::pi * (k / std::numbers::phi + turn);
  const Vector3 tangent = axis.unitOrthogonal();
  return cosine * axis + sine * (std::cos(angle) * tangent + std::sin(angle) * axis.cross(tangent));
}

class LightTracer {
 public:
  LightTracer(const PatchMesh& mesh, const PatchRays& rays, const std::vector<FrameLight>& lights,
              int reflections)
      : mesh_(mesh), rays_(rays), direct_(mesh, rays, lights), reflections_(reflections) {}

  void trace(const FrameLight& light, int paths, RandomStream& random,
             std::vector<VirtualLight>& into) const {
    const bool spot = light.kind == FrameLightKind::spot;
    const SpotCone cone(light.half_angle);
    const double end = spot ? cone.end : -1;
    const Vector3 axis = spot ? (light.target - light.position).normalized() : Vector3::UnitY();
    const double solid_angle = 2 * std::numbers::pi * (1 - end);
    const double turn = random.uniform();
    for (int k = 0; k < paths; ++k) {
      const Vector3 direction = direction_in_cap(axis, end, k, paths, turn);
      const double part = spot ? cone.part(direction.dot(axis)) : 1;
      if (part > 0) follow(light, direction, part * solid_angle / paths * light.intensity, random, into);
    }
  }

 private:
  void follow(const FrameLight& light, const Vector3& direction, const Color& flux, RandomStream& random,
              std::vector<VirtualLight>& into) const {
    PatchHit at = rays_.first_front(light.position, direction);
    // Backs, which such a ray looks through, stop light.
    if (at.missed() || !direct_.visible(at, light.position)) return;
    Color throughput = Color::Ones();
    for (int reflection = 1;; ++reflection) {
      throughput *= colour_of(mesh_.reflectance, at.patch);
      into.push_back({at, flux * throughput});
      if (reflection == reflections_) return;
      const double survival = std::min(1.0, throughput.maxCoeff());
      if (random.uniform() >= survival) return;
      throughput /= survival;
      const double u = random.uniform();
      const double v = random.uniform();
      at = rays_.from_patch(at.patch, at.point, cosine_direction(mesh_.normal.col(at.patch), u, v));
      if (at.missed() || !at.front) return;
    }
  }

  const PatchMesh& mesh_;
  const PatchRays& rays_;
  DirectLight direct_;
  int reflections_;
};

}  // namespace

std::vector<VirtualLight> virtual_lights(const PatchMesh& mesh, const PatchRays& rays,
                                         const std::vector<FrameLight>& lights, int paths, std::uint64_t seed,
                                         int reflections) {
  if (reflections < 1)
    fail<UsageError>("virtual lights of {} reflections do not exist; take 1 or more", reflections);
  if (paths < 1) fail<UsageError>("{} paths from a light are too few; at least one is needed", paths);
  if (mesh.patch_count() > 0 && !(mesh.reflectance.maxCoeff() < 1))
    fail<UsageError>("a patch has reflectance {}: paths between such patches need not end; limit it below 1",
                     mesh.reflectance.maxCoeff());
  const LightTracer tracer(mesh, rays, lights, reflections);
  std::vector<VirtualLight> found;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    RandomStream random(seed, l);
    tracer.trace(lights[l], paths, random, found);
  }
  return found;
}

}  // namespace radiosity
