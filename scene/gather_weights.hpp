#pragma once

#include "scene/patch_mesh.hpp"
#include "scene/voxel_grid.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiosity {

/// Four patches of a simplified scene and how much each counts at a point (document 000, section 3.6, step
/// 4). Weights are at least 0 and sum up to 1. Where fewer than four patches count, the others repeat the
/// first with weight 0.
struct GatherWeights {
  std::array<Index, 4> patches{};
  std::array<double, 4> weights{};

  /// The weighted mean of a field (patches x c), 1 x c: within the range of the four.
  Eigen::RowVectorXd mean(const Eigen::MatrixXd& field) const;
};

/// Finds the four patches from which light is pulled back to a point of the original surface: those with the
/// largest weights
///
///     prod_a max(0, 1 - |x_a - c_a| / h_a) * max(0, n . n_p)^2
///
/// with c the centroid of the patch and h the sides of a cell. On a wall of equal patches this is bilinear
/// interpolation; around edges it is Valve's ambient cube: squared cosines with three orthogonal patches sum
/// up to 1. Patches that face away, or sideways, never count. Where no patch is that near, those with the
/// largest (n . n_p)^2 / (distance^2 + h^2) of the whole scene are taken.
class GatherSearch {
 public:
  /// `mesh` must outlive the search. `grid`: the one that it was simplified with.
  GatherSearch(const PatchMesh& mesh, const VoxelGrid& grid);

  /// For a point with a unit normal. Throws Error where every patch faces away. Safe from several threads.
  GatherWeights at(const Vector3& point, const Vector3& normal) const;

 private:
  class Best;
  void add_near(const Vector3& point, const Vector3& normal, Best& best) const;
  void add_far(const Vector3& point, const Vector3& normal, Best& best) const;

  const PatchMesh& mesh_;
  VoxelGrid grid_;
  std::vector<std::pair<std::uint64_t, Index>> patches_;  // by the cell of the centroid
};

}  // namespace radiosity
