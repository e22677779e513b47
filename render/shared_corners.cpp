#include "render/shared_corners.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace radiosity {
namespace {

/// Patches whose normals differ by less than this (about 0.06 degrees) lie in one plane if they share a
/// corner.
constexpr double one_plane = 1e-3;

/// What patches must share to be averaged at a corner; the normal is compared apart, as it is not exact.
using CornerKey = std::tuple<double, double, double, int, int>;

struct Slot {
  Vector3 normal;
  Index row;
};

}  // namespace

SharedCorners::SharedCorners(const PatchMesh& mesh) : slots_(mesh.patches.size()) {
  std::map<CornerKey, std::vector<Slot>> corners;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
    const Vector3 normal = mesh.normal.col(i);
    for (int k = 0; k < patch.corner_count; ++k) {
      const Vector3& p = mesh.corner(i, k);
      std::vector<Slot>& here = corners[{p.x(), p.y(), p.z(), patch.group, patch.material}];
      auto found = std::find_if(here.begin(), here.end(),
                                [&](const Slot& slot) { return (slot.normal - normal).norm() < one_plane; });
      if (found == here.end()) found = here.insert(here.end(), {normal, count_++});
      slots_[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = found->row;
    }
  }
}

}  // namespace radiosity
