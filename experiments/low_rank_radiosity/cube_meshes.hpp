#pragma once

#include "scene/patch_mesh.hpp"

namespace radiosity {

/// The built-in cube in exactly `count` patches: 6 m^2 squares, or 12 m^2 halves of squares, all cut across
/// the same edge. Of two counts of which one divides the other into whole squares, the meshes are nested:
/// document 004 has 442368, 1769472, 432 and 1728 of the second kind. Throws UsageError for other counts.
PatchMesh cube_mesh(Index count);

}  // namespace radiosity
