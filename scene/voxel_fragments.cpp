#include "scene/voxel_fragments.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

// Corners nearer to a plane, relative to a cell, are on it (as in VoxelGrid::range).
constexpr double kOnPlane = 1e-6;

/// Cuts one patch after another.
class VoxelKnife {
 public:
  VoxelKnife(const PatchMesh& mesh, const VoxelGrid& grid, std::vector<VoxelFragment>& fragments)
      : mesh_(mesh), grid_(grid), fragments_(fragments) {}

  void cut(Index patch) {
    patch_ = patch;
    normal_ = mesh_.normal.col(patch);
    direction_ = dominant_direction(normal_);
    Polygon polygon;
    for (int k = 0; k < mesh_.patches[static_cast<std::size_t>(patch)].corner_count; ++k)
      polygon.push_back(mesh_.corner(patch, k));
    cut_across(0, polygon);
  }

 private:
  /// Cuts off cell after cell along an axis, and each of the parts along the next one.
  void cut_across(int axis, const Polygon& polygon) {
    if (axis == 3) {
      add(polygon);
      return;
    }
    const auto before = [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), before);
    const auto [first, last] = grid_.range(axis, (*low)[axis], (*high)[axis], normal_[axis] > 0 ? 1 : -1);
    Polygon rest = polygon;
    for (int k = first; k < last && !rest.empty(); ++k) {
      auto [part, beyond] = split_at(rest, axis, grid_.plane(axis, k + 1), kOnPlane * grid_.cell()[axis]);
      rest = std::move(beyond);
      if (part.empty()) continue;
      cell_[axis] = k;
      cut_across(axis + 1, part);
    }
    if (rest.empty()) return;
    cell_[axis] = last;
    cut_across(axis + 1, rest);
  }

  void add(const Polygon& polygon) {
    VoxelFragment fragment;
    fragment.cell = grid_.number(cell_);
    fragment.direction = direction_;
    fragment.patch = patch_;
    Vector3 moment = Vector3::Zero();
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const Vector3 a = polygon[k] - polygon[0], b = polygon[k + 1] - polygon[0];
      const double area = 0.5 * a.cross(b).dot(normal_);
      fragment.area += area;
      moment += area * (a + b) / 3;
    }
    if (!(fragment.area > 0)) return;
    fragment.centroid = polygon[0] + moment / fragment.area;
    for (const Vector3& corner : polygon) fragment.extent.extend(corner);
    fragments_.push_back(fragment);
  }

  const PatchMesh& mesh_;
  const VoxelGrid& grid_;
  std::vector<VoxelFragment>& fragments_;
  Index patch_ = 0;
  Vector3 normal_;
  int direction_ = 0;
  Eigen::Array3i cell_;
};

}  // namespace

int dominant_direction(const Vector3& normal) {
  constexpr double equal = 1e-6;
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis]) + equal) axis = other;
  return 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

std::vector<VoxelFragment> cut_into_voxels(const PatchMesh& mesh, const VoxelGrid& grid) {
  constexpr std::size_t block = 1024;
  const auto n = static_cast<std::size_t>(mesh.patch_count());
  std::vector<std::vector<VoxelFragment>> blocks((n + block - 1) / block);
  parallel_for(blocks.size(), [&](std::size_t b) {
    VoxelKnife knife(mesh, grid, blocks[b]);
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) knife.cut(static_cast<Index>(i));
  });
  std::vector<VoxelFragment> fragments;
  for (const std::vector<VoxelFragment>& part : blocks)
    fragments.insert(fragments.end(), part.begin(), part.end());
  return fragments;
}

}  // namespace radiosity
