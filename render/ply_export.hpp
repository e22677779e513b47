#pragma once

#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <filesystem>

namespace radiosity {

/// Writes the patches as binary little-endian PLY with flat colours: every patch has its own corners, in
/// patch order. Vertices: x, y, z (double, scene units), red, green, blue (8 bit sRGB of B / pi times
/// `exposure`, clamped). Faces: vertex_indices and radiosity_red, radiosity_green, radiosity_blue (double,
/// W/m^2: B itself). B is n x 1 or n x 3. Appears whole or not at all.
void write_ply(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
               double exposure);

}  // namespace radiosity
