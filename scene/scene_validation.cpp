#include "scene/scene_validation.hpp"

#include "foundation/error.hpp"
#include "scene/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

void check_index(int index, std::size_t size, std::size_t face, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= size)
    fail("face {} refers to {} {}, but there are {}", face, what, index, size);
}

void check_material(const Material& material) {
  for (const double rho : material.reflectance)
    if (!(rho >= 0 && rho <= 1))
      fail("material '{}' has reflectance {}; it must be from 0 to 1", material.name, rho);
  for (const double emission : material.emission)
    if (!(emission >= 0 && std::isfinite(emission)))
      fail("material '{}' has emission {}; it must be 0 or more", material.name, emission);
}

}  // namespace

bool is_planar_convex_quad(const std::array<Vector3, 4>& corners) {
  const Polygon polygon(corners.begin(), corners.end());
  const Vector3 area = area_vector(polygon);
  const double size = std::max((corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm());
  if (!(area.norm() > 1e-12 * size * size)) return false;
  const Vector3 normal = area.normalized();
  const Vector3 centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::abs(normal.dot(corners[k] - centre)) > kPlanarityTolerance * size) return false;
    const Vector3 along = corners[(k + 1) % 4] - corners[k];
    if (along.norm() <= kPlanarityTolerance * size) return false;
    if (along.cross(corners[(k + 2) % 4] - corners[k]).dot(normal) < 0) return false;
  }
  return true;
}

void validate(const Scene& scene) {
  for (std::size_t i = 0; i < scene.vertices.size(); ++i)
    if (!scene.vertices[i].allFinite()) fail("vertex {} of '{}' is not finite", i, scene.name);
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const Face& face = scene.faces[f];
    if (face.corner_count != 3 && face.corner_count != 4)
      fail("face {} of '{}' has {} corners; only triangles and quads are faces", f, scene.name,
           face.corner_count);
    for (int k = 0; k < face.corner_count; ++k)
      check_index(face.corners[static_cast<std::size_t>(k)], scene.vertices.size(), f, "vertex");
    check_index(face.material, scene.materials.size(), f, "material");
    check_index(face.group, scene.groups.size(), f, "group");
    if (face.corner_count == 4 &&
        !is_planar_convex_quad({corner(scene, face, 0), corner(scene, face, 1), corner(scene, face, 2),
                                corner(scene, face, 3)}) &&
        area_vector(scene, face).norm() > 0)
      fail("face {} of '{}' is a quad that is not planar and convex; split it into triangles", f, scene.name);
  }
  for (const Material& material : scene.materials) check_material(material);
}

}  // namespace radiosity
