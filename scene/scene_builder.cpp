#include "scene/scene_builder.hpp"

#include <algorithm>

namespace radiosity {

int SceneBuilder::material(Material material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<int>(scene_.materials.size()) - 1;
}

int SceneBuilder::group(const std::string& name) {
  const auto found = std::find(scene_.groups.begin(), scene_.groups.end(), name);
  if (found != scene_.groups.end()) return static_cast<int>(found - scene_.groups.begin());
  scene_.groups.push_back(name);
  return static_cast<int>(scene_.groups.size()) - 1;
}

int SceneBuilder::vertex(const Vector3& position) {
  const auto [found, added] = vertices_.try_emplace({position.x(), position.y(), position.z()},
                                                    static_cast<int>(scene_.vertices.size()));
  if (added) scene_.vertices.push_back(position);
  return found->second;
}

void SceneBuilder::face(const std::vector<Vector3>& corners, int material, int group) {
  Face face;
  face.corner_count = static_cast<int>(corners.size());
  face.material = material;
  face.group = group;
  for (std::size_t k = 0; k < corners.size(); ++k) face.corners[k] = vertex(corners[k]);
  scene_.faces.push_back(face);
}

}  // namespace radiosity
