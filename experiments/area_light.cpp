#include "experiments/area_light.hpp"

#include "experiments/disc_cover.hpp"
#include "render/bounding_box.hpp"
#include "render/path_sampling.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {

namespace {

Index patch_by_area(const PatchMesh& mesh, double fraction) {
  double rest = fraction * mesh.area.sum();
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    rest -= mesh.area[i];
    if (rest < 0) return i;
  }
  return mesh.patch_count() - 1;
}

}  // namespace

Light draw_area_light(const PatchMesh& mesh, RandomStream& random) {
  Light light;
  light.kind = LightKind::area;
  light.patch = patch_by_area(mesh, random.uniform());
  const double u = random.uniform();
  const double v = random.uniform();
  light.position = point_on_patch(mesh, light.patch, u, v);
  light.radius = random.uniform(0.02, 0.15) * bounding_box(mesh).diagonal().norm();
  return light;
}

Eigen::VectorXd area_light_cover(const PatchMesh& mesh, const Light& light) {
  const Vector3 normal = mesh.normal.col(light.patch);
  const Vector3 first = normal.unitOrthogonal();
  const Vector3 second = normal.cross(first);
  const int group = mesh.patches[static_cast<std::size_t>(light.patch)].group;
  const double slack = 1e-6 * bounding_box(mesh).diagonal().norm();

  Eigen::VectorXd cover = Eigen::VectorXd::Zero(mesh.patch_count());
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
    const double height = normal.dot(mesh.centroid.col(i) - light.position);
    if (patch.group != group || std::abs(height) > slack || mesh.normal.col(i).dot(normal) < 1 - 1e-9)
      continue;
    std::array<Eigen::Vector2d, 4> polygon;
    for (int k = 0; k < patch.corner_count; ++k) {
      const Vector3 offset = mesh.corner(i, k) - light.position;
      polygon[static_cast<std::size_t>(k)] = {first.dot(offset), second.dot(offset)};
    }
    const std::span<const Eigen::Vector2d> corners(polygon.data(),
                                                   static_cast<std::size_t>(patch.corner_count));
    cover[i] = std::min(1.0, disc_polygon_area(corners, light.radius) / mesh.area[i]);
  }
  return cover;
}

}  // namespace radiosity
