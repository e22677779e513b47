#pragma once

#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace radiosity {

/// Radiosity at the corners of each patch, for Gouraud shading (003, section 4): the area-weighted average
/// over the patches that meet at that corner, lie in the same plane and share group and material. So shading
/// never bleeds around an edge, and since faces are cut along what stands on them, no covered patch darkens
/// its neighbours (003's Fig. 7).
class VertexRadiosity {
 public:
  /// B is n x c, W/m^2; or 4 n x c where it is known at the corners, corner k of patch i in row 4 i + k.
  /// Throws UsageError for another number of rows.
  VertexRadiosity(const PatchMesh& mesh, const Eigen::MatrixXd& B);

  /// Corner k of a patch, 1 x c, W/m^2.
  Eigen::RowVectorXd corner(Index patch, int k) const { return values_.row(slot(patch, k)); }

  /// Interpolated at a point of a patch: barycentric on triangles, bilinear on rectangles (Wachspress
  /// coordinates).
  Eigen::RowVectorXd at(Index patch, const Vector3& point) const;

 private:
  Index slot(Index patch, int k) const {
    return slots_[static_cast<std::size_t>(patch)][static_cast<std::size_t>(k)];
  }

  const PatchMesh& mesh_;
  std::vector<std::array<Index, 4>> slots_;  // row of values_ for each corner
  Eigen::MatrixXd values_;
};

}  // namespace radiosity
