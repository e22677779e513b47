#pragma once

#include "foundation/monitor.hpp"
#include "render/picture.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace radiosity {

/// The extensions that write_solution() knows, with a line about each.
struct SolutionFormat {
  std::string extension;  ///< with its dot, lower case
  std::string summary;
};
const std::vector<SolutionFormat>& solution_formats();

/// Throws UsageError that lists the known extensions if `file` has none of them: to be asked before long work
/// begins.
void check_solution_format(const std::filesystem::path& file);

/// Writes a solution B (n x 1 or n x 3, W/m^2) in the format that the extension names:
/// .glb and .ply (patches with colours), .exr and .png (picture from the scene's camera), .npy (B as it is, n
/// x c). `picture` and `corners` (of render_picture) are for .exr and .png only. Returns one sentence about
/// what was written, with the exposure where there is one. Appears whole or not at all. Throws UsageError for
/// an unknown extension or a wrong shape of B, Error if it cannot write.
std::string write_solution(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
                           const PictureOptions& picture, Monitor& monitor,
                           const Eigen::MatrixXd& corners = {});

}  // namespace radiosity
