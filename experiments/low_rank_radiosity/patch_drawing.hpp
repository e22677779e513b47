#pragma once

#include "foundation/monitor.hpp"
#include "render/picture.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace radiosity {

struct PatchDrawingOptions {
  int width = 420;  ///< pixels
  int height = 420;
  double line_width = 1;  ///< of the borders between patches, pixels; 0: no lines
};

/// Draws patches in flat colours (n x 3, linear RGB from 0 to 1) with dark lines where one patch ends and
/// another begins, on white, from the scene's camera or from default_camera() where it has none. Backs are
/// looked through. The picture is for a screen: tone mapping with exposure 1 shows the colours as they are.
/// Throws UsageError where sizes do not fit.
Picture draw_patches(const PatchMesh& mesh, const Eigen::MatrixXd& colours,
                     const PatchDrawingOptions& options, Monitor& monitor);

/// The reflectance of each patch, darker where its plane is seen at an angle, so that the faces of a white
/// block can be told apart: n x 3.
Eigen::MatrixXd shaded_reflectance(const PatchMesh& mesh);

/// Multiplies radiances with one exposure, that of the brightest picture (render/tone_mapping.hpp), so that
/// they can be compared on a screen.
void expose_alike(std::vector<Picture>& pictures);

/// Pictures of one height side by side on white.
Picture side_by_side(const std::vector<Picture>& pictures);

/// PNG of a picture whose colours are for a screen.
void write_drawing(const std::filesystem::path& file, const Picture& picture);

}  // namespace radiosity
