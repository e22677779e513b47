#pragma once

#include "factorizations/cosines.hpp"
#include "scene/patch_mesh.hpp"

#include <vector>

namespace radiosity {

/// The patches that lie in one plane and belong to one group of the scene, with the places of their centroids
/// in the rectangle that they fill. Where a mesh has no places (form factors made by hand), all patches in
/// their order on one line.
std::vector<PlacedSet> patch_planes(const PatchMesh& mesh);

}  // namespace radiosity
