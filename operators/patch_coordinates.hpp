#pragma once

#include "scene/patch_mesh.hpp"

namespace radiosity {

/// Where the patches are and face: 6 x n, places and directions alike in size; patch numbers if that is not
/// known (form factors made by hand).
Eigen::MatrixXd patch_coordinates(const PatchMesh& mesh);

}  // namespace radiosity
