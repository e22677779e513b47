#pragma once

#include "scene/patch_mesh.hpp"

#include <Eigen/Geometry>

namespace radiosity {

/// Of all corners of all patches, in scene units; empty without patches.
inline Eigen::AlignedBox3d bounding_box(const PatchMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k)
      box.extend(mesh.corner(i, k));
  return box;
}

}  // namespace radiosity
