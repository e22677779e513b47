#include "form_factors/moved_pairs.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

/// `after`, if the meshes differ in positions at most.
const PatchMesh& require_likeness(const PatchMesh& before, const PatchMesh& after,
                                  const std::vector<bool>& moved) {
  if (before.patch_count() != after.patch_count() || moved.size() != after.scene->faces.size())
    fail<UsageError>(
        "meshes of {} and {} patches, and {} faces of which it is said whether they moved where the scene "
        "has "
        "{}: what moves must be cut into the same patches before and after",
        before.patch_count(), after.patch_count(), moved.size(), after.scene->faces.size());
  return after;
}

/// The box around the patches that have moved.
Eigen::AlignedBox3d box_of_moved(const PatchMesh& mesh, const std::vector<bool>& moved) {
  Eigen::AlignedBox3d box;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
    if (!moved[static_cast<std::size_t>(patch.face)]) continue;
    for (int k = 0; k < patch.corner_count; ++k) box.extend(mesh.corner(i, k));
  }
  return box;
}

/// Whether all corners of a patch lie behind the plane of another.
bool is_behind(const PatchMesh& mesh, Index patch, const PatchMesh& other_mesh, Index other) {
  const Vector3 normal = other_mesh.normal.col(other);
  const double plane = normal.dot(other_mesh.centroid.col(other));
  const int corners = mesh.patches[static_cast<std::size_t>(patch)].corner_count;
  for (int k = 0; k < corners; ++k)
    if (normal.dot(mesh.corner(patch, k)) > plane) return false;
  return true;
}

/// The shaft between two patches: the convex hull of their corners.
struct Shaft {
  std::array<Vector3, 8> corners;
  int count = 0;

  void add(const PatchMesh& mesh, Index patch) {
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(patch)].corner_count; ++k)
      corners[static_cast<std::size_t>(count++)] = mesh.corner(patch, k);
  }

  /// Whether a plane with this normal has the box on one side and the shaft on the other.
  bool is_separated_along(const Vector3& normal, const Eigen::AlignedBox3d& box) const {
    const Vector3 half = 0.5 * box.sizes();
    const double middle = normal.dot(box.center());
    const double reach = normal.cwiseAbs().dot(half);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int k = 0; k < count; ++k) {
      const double at = normal.dot(corners[static_cast<std::size_t>(k)]) - middle;
      low = std::min(low, at);
      high = std::max(high, at);
    }
    return low > reach || high < -reach;
  }
};

/// Whether no plane that is tried has the shaft between two patches and the box on different sides.
bool may_stand_between(const Eigen::AlignedBox3d& box, const PatchMesh& elements, Index e,
                       const PatchMesh& patches, Index p) {
  if (box.isEmpty()) return false;
  Shaft shaft;
  shaft.add(elements, e);
  shaft.add(patches, p);
  for (int axis = 0; axis < 3; ++axis)
    if (shaft.is_separated_along(Vector3::Unit(axis), box)) return false;
  const Vector3 along = patches.centroid.col(p) - elements.centroid.col(e);
  for (int axis = 0; axis < 3; ++axis)
    if (shaft.is_separated_along(along.cross(Vector3::Unit(axis)), box)) return false;
  // About parallel to the sides of the shaft: along it and an edge of one end.
  for (const auto& [mesh, end] : {std::pair(&elements, e), std::pair(&patches, p)}) {
    const int corners = mesh->patches[static_cast<std::size_t>(end)].corner_count;
    for (int k = 0; k < corners; ++k) {
      const Vector3 edge = mesh->corner(end, (k + 1) % corners) - mesh->corner(end, k);
      if (shaft.is_separated_along(along.cross(edge), box)) return false;
    }
  }
  return true;
}

std::vector<bool> moved_patches(const PatchMesh& mesh, const std::vector<bool>& moved_faces) {
  std::vector<bool> moved;
  moved.reserve(mesh.patches.size());
  for (const Patch& patch : mesh.patches) moved.push_back(moved_faces[static_cast<std::size_t>(patch.face)]);
  return moved;
}

}  // namespace

MovedPairs::MovedPairs(const PatchMesh& elements_before, const PatchMesh& elements, const PatchMesh& patches,
                       const std::vector<bool>& moved)
    : element_moved_(moved_patches(require_likeness(elements_before, elements, moved), moved)),
      patch_moved_(moved_patches(patches, moved)),
      may_differ_(patches.patch_count(), elements.patch_count()) {
  const Eigen::AlignedBox3d before = box_of_moved(elements_before, moved);
  const Eigen::AlignedBox3d after = box_of_moved(elements, moved);
  const auto may_differ = [&](Index e, Index p) {
    if (has_moved(e, p)) return true;
    if (is_behind(elements, e, patches, p) || is_behind(patches, p, elements, e)) return false;
    return may_stand_between(before, elements, e, patches, p) ||
           may_stand_between(after, elements, e, patches, p);
  };
  parallel_for(static_cast<std::size_t>(elements.patch_count()), [&](std::size_t element) {
    const auto e = static_cast<Index>(element);
    for (Index p = 0; p < patches.patch_count(); ++p) may_differ_(p, e) = may_differ(e, p) ? 1 : 0;
  });
}

double MovedPairs::fraction() const {
  return may_differ_.cast<double>().mean();
}

}  // namespace radiosity
