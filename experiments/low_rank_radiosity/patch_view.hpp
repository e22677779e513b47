#pragma once

#include "foundation/monitor.hpp"
#include "render/patch_rays.hpp"
#include "render/picture.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

namespace radiosity {

/// What the middle of a patch sees, on a disc: the hemisphere projected on the plane of the patch, so that
/// the area that a surface covers, as a fraction of the disc, is its form factor (Nusselt). Colours are
/// `exposure` times the radiance B / pi (B: n x 1 or n x 3, W/m^2), for a screen; around the disc it is
/// white. `size` pixels each way. Up is the y axis where the patch is not level, else the way into the scene,
/// -z.
Picture draw_view(const PatchMesh& mesh, const PatchRays& rays, Index patch, const Eigen::MatrixXd& B,
                  double exposure, int size, Monitor& monitor);

}  // namespace radiosity
