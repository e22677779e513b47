#pragma once

#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <filesystem>

namespace radiosity {

/// Writes the patches as binary glTF 2.0 with flat colours: every patch has its own corners.
/// COLOR_0: linear RGB, B / pi times `exposure`, clamped to [0, 1] as glTF demands; the material is unlit
/// (KHR_materials_unlit). _RADIOSITY: B itself, W/m^2, float32. asset.extras.exposure: the constant.
/// Positions are float32 about the centre of the scene, which is the node's translation. B is n x 1 or n x 3.
/// Appears whole or not at all. Throws Error if there are no patches or the file would pass glTF's 4 GiB.
void write_glb(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
               double exposure);

}  // namespace radiosity
