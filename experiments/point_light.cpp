#include "experiments/point_light.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "render/bounding_box.hpp"
#include "render/path_sampling.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {

namespace {

constexpr int strata = 4;  ///< shadow rays a patch: strata x strata
constexpr int directions = 64;

Vector3 uniform_direction(RandomStream& random) {
  const double z = random.uniform(-1, 1);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

double triangle_solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2 * std::atan2(std::abs(a.dot(b.cross(c))),
                        la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
}

}  // namespace

double front_solid_angle(const PatchMesh& mesh, Index patch, const Vector3& position) {
  if (mesh.normal.col(patch).dot(position - mesh.centroid.col(patch)) <= 0) return 0;
  const int corners = mesh.patches[static_cast<std::size_t>(patch)].corner_count;
  double angle = 0;
  for (int k = 1; k + 1 < corners; ++k)
    angle += triangle_solid_angle(mesh.corner(patch, 0) - position, mesh.corner(patch, k) - position,
                                  mesh.corner(patch, k + 1) - position);
  return angle;
}

PointLights::PointLights(const PatchMesh& mesh) : mesh_(mesh), rays_(mesh) {}

bool PointLights::visible(Index patch, const Vector3& point, const Vector3& position) const {
  const Vector3 way = position - point;
  const double distance = way.norm();
  const PatchHit hit = rays_.from_patch(patch, point, way / distance);
  return hit.missed() || (hit.point - point).norm() >= distance;
}

bool PointLights::outside_solids(const Vector3& position, RandomStream& random) const {
  int fronts = 0;
  int backs = 0;
  for (int k = 0; k < directions; ++k) {
    // The first front in this direction, and then back from it: whatever stands between shows its back to the
    // light.
    const PatchHit hit = rays_.first_front(position, uniform_direction(random));
    if (hit.missed()) continue;
    ++(visible(hit.patch, hit.point, position) ? fronts : backs);
  }
  return fronts > 0 && fronts >= 3 * backs;
}

double PointLights::visible_part(Index patch, const Vector3& position, RandomStream& random) const {
  double seen = 0;
  double all = 0;
  for (int row = 0; row < strata; ++row)
    for (int column = 0; column < strata; ++column) {
      const double u = (row + random.uniform()) / strata;
      const double v = (column + random.uniform()) / strata;
      const Vector3 point = point_on_patch(mesh_, patch, u, v);
      const double distance = (position - point).norm();
      const double weight =
          1 / (distance * distance * distance);  // cosine / distance^2, but for a constant height
      all += weight;
      if (visible(patch, point, position)) seen += weight;
    }
  return seen / all;
}

Eigen::VectorXd PointLights::irradiance(const Vector3& position, std::uint64_t seed) const {
  Eigen::VectorXd received = Eigen::VectorXd::Zero(mesh_.patch_count());
  parallel_for(
      static_cast<std::size_t>(mesh_.patch_count()),
      [&](std::size_t k) {
        const auto patch = static_cast<Index>(k);
        const double angle = front_solid_angle(mesh_, patch, position);
        if (angle == 0) return;
        RandomStream random(seed, k);
        received[patch] =
            angle / (4 * std::numbers::pi * mesh_.area[patch]) * visible_part(patch, position, random);
      },
      64);
  return received;
}

std::pair<Light, Eigen::VectorXd> PointLights::draw(RandomStream& random) const {
  const Eigen::AlignedBox3d box = bounding_box(mesh_);
  constexpr int tries = 1000;
  for (int attempt = 0; attempt < tries; ++attempt) {
    Light light;
    light.kind = LightKind::point;
    for (int axis = 0; axis < 3; ++axis)
      light.position[axis] = box.min()[axis] + random.uniform(0.1, 0.9) * box.sizes()[axis];
    if (!outside_solids(light.position, random)) continue;
    const Eigen::VectorXd received = irradiance(light.position, random());
    if (received.dot(mesh_.reflectance.rowwise().sum()) > 0) return {light, received};
  }
  fail(
      "No place for a point light was found in {} tries: every point of the inner 80 % of the bounding box "
      "lies in a solid, "
      "or nothing that it lights reflects; ask for area or patch lights.",
      tries);
}

}  // namespace radiosity
