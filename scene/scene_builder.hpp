#pragma once

#include "scene/scene.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace radiosity {

/// Assembles a Scene from polygons: vertices that are equal bit by bit are shared, equal group names are
/// merged.
class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name) { scene_.name = std::move(name); }

  int material(Material material);
  int group(const std::string& name);

  /// Adds a face with corners counter-clockwise seen from the front: 3 or 4, and 4 must be planar and convex.
  void face(const std::vector<Vector3>& corners, int material, int group);

  Scene& scene() { return scene_; }

 private:
  int vertex(const Vector3& position);

  Scene scene_;
  std::map<std::array<double, 3>, int> vertices_;
};

}  // namespace radiosity
