#pragma once

#include "scene/patch_mesh.hpp"

#include <array>
#include <vector>

namespace radiosity {

/// The vertices that smooth shading interpolates between: corners of patches that meet in one point, lie in
/// the same plane and share group and material are one. So shading never bleeds around an edge, and since
/// faces are cut along what stands on them, no covered patch darkens its neighbours (document 003, Fig. 7).
class SharedCorners {
 public:
  explicit SharedCorners(const PatchMesh& mesh);

  /// How many there are.
  Index count() const { return count_; }
  /// That of corner k of a patch.
  Index of(Index patch, int k) const {
    return slots_[static_cast<std::size_t>(patch)][static_cast<std::size_t>(k)];
  }

 private:
  std::vector<std::array<Index, 4>> slots_;
  Index count_ = 0;
};

}  // namespace radiosity
