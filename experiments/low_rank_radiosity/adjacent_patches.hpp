#pragma once

#include "scene/patch_mesh.hpp"

#include <utility>
#include <vector>

namespace radiosity {

/// Pairs i < j of patches that lie in different planes and share a piece of an edge longer than `tolerance`
/// times the shorter of the two edges: F between them does not fall as patches are made smaller.
std::vector<std::pair<Index, Index>> adjacent_patches(const PatchMesh& mesh, double tolerance = 1e-6);

}  // namespace radiosity
