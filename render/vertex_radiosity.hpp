#pragma once

#include "render/shared_corners.hpp"

#include <Eigen/Core>

namespace radiosity {

/// Radiosity at the corners of each patch, for Gouraud shading (003, section 4): the area-weighted average
/// over the patches that share it (render/shared_corners.hpp).
class VertexRadiosity {
 public:
  /// B is n x c, W/m^2; or 4 n x c where it is known at the corners, corner k of patch i in row 4 i + k.
  /// Throws UsageError for another number of rows.
  VertexRadiosity(const PatchMesh& mesh, const Eigen::MatrixXd& B);

  /// Corner k of a patch, 1 x c, W/m^2.
  Eigen::RowVectorXd corner(Index patch, int k) const { return values_.row(corners_.of(patch, k)); }

  /// Interpolated at a point of a patch: barycentric on triangles, bilinear on rectangles (Wachspress
  /// coordinates).
  Eigen::RowVectorXd at(Index patch, const Vector3& point) const;

 private:
  const PatchMesh& mesh_;
  SharedCorners corners_;
  Eigen::MatrixXd values_;
};

}  // namespace radiosity
