#pragma once

#include "experiments/lights.hpp"
#include "foundation/random.hpp"

namespace radiosity {

/// A disc: centre uniform by area, radius uniform in [0.02, 0.15] x the diagonal of the bounding box.
Light draw_area_light(const PatchMesh& mesh, RandomStream& random);

/// The fraction of each patch that the disc covers, n, 0 to 1; 0 outside the group and plane of the patch at
/// its centre.
Eigen::VectorXd area_light_cover(const PatchMesh& mesh, const Light& light);

}  // namespace radiosity
