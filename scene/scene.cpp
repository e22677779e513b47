#include "scene/scene.hpp"

#include "scene/contacts.hpp"

#include <algorithm>

namespace radiosity {

Vector3 area_vector(const Scene& scene, const Face& face) {
  const Vector3& origin = corner(scene, face, 0);
  Vector3 doubled = Vector3::Zero();
  for (int k = 1; k + 1 < face.corner_count; ++k)
    doubled += (corner(scene, face, k) - origin).cross(corner(scene, face, k + 1) - origin);
  return 0.5 * doubled;
}

double diagonal(const Scene& scene) {
  if (scene.vertices.empty()) return 0;
  Vector3 low = scene.vertices.front(), high = low;
  for (const Vector3& vertex : scene.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return (high - low).norm();
}

Scene two_sided(const Scene& scene) {
  Scene result = scene.contacts == Contacts::always ? without_contacts(scene) : scene;
  result.contacts = Contacts::never;
  const std::vector<Face> fronts = result.faces;
  for (Face twin : fronts) {
    std::reverse(twin.corners.begin(), twin.corners.begin() + twin.corner_count);
    result.faces.push_back(twin);
  }
  return result;
}

}  // namespace radiosity
