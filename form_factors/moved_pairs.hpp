#pragma once

#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// Which form factors between elements and patches may differ after some faces of a scene have moved: those
/// of what has moved, and those of pairs between which it may stand now or may have stood before. Safe, not
/// sharp: a pair is left out where the two do not face each other, or where one of some planes has the shaft
/// between them on one side and the bounding box of what moved on the other.
class MovedPairs {
 public:
  /// The meshes before and after, alike but for the positions of vertices; `moved`: for each face of the
  /// scene, whether it has moved. Throws UsageError where the meshes do not fit.
  MovedPairs(const PatchMesh& elements_before, const PatchMesh& elements, const PatchMesh& patches,
             const std::vector<bool>& moved);

  /// Whether F_ep may differ.
  bool operator()(Index e, Index p) const { return may_differ_(p, e) != 0; }
  /// Whether e or p has moved itself.
  bool has_moved(Index e, Index p) const {
    return element_moved_[static_cast<std::size_t>(e)] || patch_moved_[static_cast<std::size_t>(p)];
  }
  /// Of all pairs those that may differ.
  double fraction() const;

 private:
  std::vector<bool> element_moved_;
  std::vector<bool> patch_moved_;
  Eigen::Matrix<unsigned char, Eigen::Dynamic, Eigen::Dynamic> may_differ_;  ///< k x n
};

}  // namespace radiosity
