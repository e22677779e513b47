#pragma once

#include "render/picture.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace radiosity {

/// The pixels that see one side of a column, in bands from its foot to its head.
struct ColumnBands {
  std::vector<double> height;                    ///< of the middle of each band, scene units, rising
  std::vector<std::vector<std::size_t>> pixels;  ///< of each band, at least one; counted row by row
};

/// Of the patches of a group whose normal that is: bands of equal height, each pixel in that of the point
/// which its middle sees. Throws UsageError where there is no such group or a band has no pixel.
ColumnBands column_bands(const PatchMesh& mesh, const std::string& group, const Vector3& normal,
                         const Camera& camera, int width, int height, int bands);

/// Mean radiance of each band, bands x 3, W/(m^2 sr).
Eigen::MatrixX3d profile_of(const Picture& picture, const ColumnBands& bands);

/// The colour gradient along the column that document 000 holds against light propagation volumes (section
/// 4.2): the slope over height of red / (red + green + blue), by least squares, per scene unit.
double colour_gradient(const ColumnBands& bands, const Eigen::MatrixX3d& profile);

/// Root mean square over bands of profile - reference, relative to the mean of the reference: red, green,
/// blue.
Eigen::Array3d profile_error(const Eigen::MatrixX3d& profile, const Eigen::MatrixX3d& reference);

}  // namespace radiosity
