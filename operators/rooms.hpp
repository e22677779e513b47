#pragma once

#include "form_factors/form_factors.hpp"

#include <vector>

namespace radiosity {

/// A partition of the patches into sets, such as rooms that exchange little light with each other.
struct Rooms {
  std::vector<int> of_patch;  ///< n numbers 0 ... count - 1; -1: a patch that sees nothing
  int count = 0;

  /// n x count, orthonormal: column r is A^{1/2} on room r, scaled; patches of no room have zero rows.
  Eigen::MatrixXd indicators(const Eigen::VectorXd& root_area) const;
};

/// Rooms found from the kernel alone: as many as light has modes that lose less than a fifth of their energy
/// to other rooms a bounce (eigenvalues above 0.8 of F with rows scaled to 1; a cube has 0.5 beside the 1 of
/// its own, the Cornell box 0.75), at most 64. Deterministic. Throws UsageError where F has no symmetric
/// kernel.
Rooms find_rooms(const FormFactors& form_factors);

/// One set a group of the mesh.
Rooms rooms_of_groups(const FormFactors& form_factors);

/// `count` compact sets of patches (fewer only if there are fewer patches): the rooms, cut in halves of equal
/// size across the longest extent in place and direction, largest area first.
Rooms divide_rooms(const FormFactors& form_factors, const Rooms& rooms, int count);

}  // namespace radiosity
