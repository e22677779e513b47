#pragma once

#include "scene/patch_mesh.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

namespace radiosity {

/// Number of patch edges that no neighbour runs along the opposite way, from corner to corner: 0 for a
/// watertight mesh without T-junctions.
inline int unmatched_edges(const PatchMesh& mesh) {
  std::map<std::pair<int, int>, int> balance;
  for (const Patch& patch : mesh.patches)
    for (int k = 0; k < patch.corner_count; ++k) {
      const int from = patch.corners[static_cast<std::size_t>(k)];
      const int to = patch.corners[static_cast<std::size_t>((k + 1) % patch.corner_count)];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  int unmatched = 0;
  for (const auto& [edge, sum] : balance) unmatched += std::abs(sum);
  return unmatched;
}

inline const std::string& group_name(const PatchMesh& mesh, Index patch) {
  return mesh.scene->groups[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(patch)].group)];
}

/// Area of each group by name.
inline std::map<std::string, double> area_by_group(const PatchMesh& mesh) {
  std::map<std::string, double> areas;
  for (Index i = 0; i < mesh.patch_count(); ++i) areas[group_name(mesh, i)] += mesh.area[i];
  return areas;
}

}  // namespace radiosity
