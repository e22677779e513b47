#include "scene/face_duplicates.hpp"

#include "scene/vertex_welding.hpp"

#include <algorithm>

namespace radiosity {

DuplicateFaces find_duplicates(const Scene& scene) {
  const std::vector<int> welded = weld(scene.vertices, 1e-9 * diagonal(scene));
  std::vector<std::pair<std::array<int, 4>, std::size_t>> keys;
  keys.reserve(scene.faces.size());
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const Face& face = scene.faces[f];
    std::array<int, 4> key{-1, -1, -1, -1};
    for (int k = 0; k < face.corner_count; ++k)
      key[static_cast<std::size_t>(k)] =
          welded[static_cast<std::size_t>(face.corners[static_cast<std::size_t>(k)])];
    std::rotate(key.begin(), std::min_element(key.begin(), key.begin() + face.corner_count),
                key.begin() + face.corner_count);
    keys.emplace_back(key, f);
  }
  std::sort(keys.begin(), keys.end());
  DuplicateFaces result;
  result.first = scene.faces.size();
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].first != keys[i - 1].first) continue;
    ++result.count;
    result.first = std::min(result.first, keys[i].second);
  }
  return result;
}

}  // namespace radiosity
