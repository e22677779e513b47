#pragma once

#include "scene/scene.hpp"

#include <map>
#include <string>
#include <vector>

namespace radiosity {

/// Collects what an importer reads: polygons become faces, names become groups and materials.
class ImportedFaces {
 public:
  explicit ImportedFaces(std::string name) { scene_.name = std::move(name); }

  Scene& scene() { return scene_; }

  /// Index of the group of that name, made if it is new. A group should only be asked for when a face needs
  /// it.
  int group(const std::string& name);

  /// A polygon with at least three corners that index scene().vertices. A planar convex quad stays one face,
  /// others become triangles; a polygon that crosses itself becomes a fan.
  void polygon(const std::vector<int>& corners, int material, int group);

  /// Adds what was changed to the scene's notes and returns it. Throws Error if there is no face.
  Scene finish(const std::string& file);

 private:
  void face(const std::vector<int>& corners, int material, int group);

  Scene scene_;
  std::map<std::string, int> groups_;
  std::size_t split_polygons_ = 0;
  std::size_t crossed_polygons_ = 0;
};

}  // namespace radiosity
