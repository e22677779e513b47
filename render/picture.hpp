#pragma once

#include "foundation/monitor.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace radiosity {

/// A linear RGB picture of radiance, W/(m^2 sr), rows from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<float> pixels;  ///< 3 x width x height: red, green, blue of each pixel

  float* pixel(int x, int y) { return pixels.data() + 3 * (static_cast<std::size_t>(y) * width + x); }
  const float* pixel(int x, int y) const {
    return pixels.data() + 3 * (static_cast<std::size_t>(y) * width + x);
  }
};

struct PictureOptions {
  int width = 800;  ///< pixels, 1 ... 16384
  int height = 800;
  int supersampling = 3;     ///< rays a pixel in each direction, 1 ... 8, on a regular grid
  bool interpolate = false;  ///< Gouraud shading (003, section 4) in place of flat patches
};

/// Draws the radiance B / pi of the patches from the scene's camera, or from default_camera() where it has
/// none. B is n x 1 or n x 3, W/m^2. Interpolation starts from `corners` (4 n rows, as in VertexRadiosity) if
/// they are given, else from B. Backs are looked through, so that a closed room can be seen from
/// outside; where a ray meets no front the picture is black. Throws UsageError for wrong shapes and options
/// out of range.
Picture render_picture(const PatchMesh& mesh, const Eigen::MatrixXd& B, const PictureOptions& options,
                       Monitor& monitor, const Eigen::MatrixXd& corners = {});

}  // namespace radiosity
