#pragma once

#include "scene/patch_mesh.hpp"
#include "scene/voxel_grid.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace radiosity {

/// One of the six signed axis directions: 2 axis + (1 if negative).
/// That of a normal is its largest component; of equal ones (within 1e-6) the first of x, y, z, so that a
/// tessellated slope of 45 degrees does not fall apart.
int dominant_direction(const Vector3& normal);

constexpr int axis_of(int direction) {
  return direction / 2;
}
constexpr int sign_of(int direction) {
  return direction % 2 == 0 ? 1 : -1;
}

/// The part of a patch in one cell of a grid.
struct VoxelFragment {
  std::uint64_t cell = 0;  ///< its number
  int direction = 0;       ///< the dominant direction of the patch
  Index patch = 0;
  double area = 0;  ///< true area, scene units squared
  Vector3 centroid = Vector3::Zero();
  Eigen::AlignedBox3d extent;
};

/// What the fragments of one quad share, its cell and direction; quads are in the order of these numbers.
constexpr std::uint64_t quad_key(const VoxelFragment& fragment) {
  return 6 * fragment.cell + static_cast<std::uint64_t>(fragment.direction);
}

/// Cuts every patch exactly along the cells: the areas of its fragments sum up to its own, up to rounding.
/// Patch by patch, in the same order in every run.
std::vector<VoxelFragment> cut_into_voxels(const PatchMesh& mesh, const VoxelGrid& grid);

}  // namespace radiosity
