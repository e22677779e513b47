#include "scene/imported_faces.hpp"

#include "foundation/error.hpp"
#include "scene/polygon.hpp"
#include "scene/scene_validation.hpp"

#include <cmath>

namespace radiosity {

int ImportedFaces::group(const std::string& name) {
  const auto [found, is_new] = groups_.emplace(name, static_cast<int>(scene_.groups.size()));
  if (is_new) scene_.groups.push_back(name);
  return found->second;
}

void ImportedFaces::face(const std::vector<int>& corners, int material, int group) {
  Face face;
  face.corner_count = static_cast<int>(corners.size());
  face.material = material;
  face.group = group;
  for (std::size_t k = 0; k < corners.size(); ++k) face.corners[k] = corners[k];
  scene_.faces.push_back(face);
}

void ImportedFaces::polygon(const std::vector<int>& corners, int material, int group) {
  if (corners.size() == 3) return face(corners, material, group);
  Polygon points;
  for (const int corner : corners) points.push_back(scene_.vertices[static_cast<std::size_t>(corner)]);
  if (points.size() == 4 && is_planar_convex_quad({points[0], points[1], points[2], points[3]}))
    return face(corners, material, group);

  ++split_polygons_;
  const Vector3 area = area_vector(points);
  auto triangles = triangulate(points, area.normalized(), 1e-9 * std::sqrt(area.norm()));
  if (triangles.empty()) {
    if (!area.isZero()) ++crossed_polygons_;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) triangles.push_back({0, k, k + 1});
  }
  for (const auto& [a, b, c] : triangles) face({corners[a], corners[b], corners[c]}, material, group);
}

Scene ImportedFaces::finish(const std::string& file) {
  if (scene_.faces.empty()) fail("'{}' has no faces: nothing to light", file);
  if (split_polygons_ > 0)
    scene_.notes.push_back(
        fmt::format("{} polygons that are not planar convex quads were cut into triangles", split_polygons_));
  if (crossed_polygons_ > 0)
    scene_.notes.push_back(fmt::format(
        "{} polygons cross themselves and were cut as fans around their first corner", crossed_polygons_));
  return std::move(scene_);
}

}  // namespace radiosity
