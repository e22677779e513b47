#pragma once

#include "scene/coarse_mesh.hpp"

#include <cstdint>
#include <optional>

namespace radiosity {

struct CoherentMeshOptions {
  double threshold = 0;   ///< patches whose views differ by no more are coherent and stay whole
  double least_area = 0;  ///< A_min, m^2: no patch of this area or less is cut, nor one of a single element
  int directions = 256;   ///< of a scene view
  std::uint64_t seed = 1;
};

/// The coarse mesh of Algorithm 1 (document 004): patches inside which scene views vary are cut in two while
/// their area is above A_min; cuts run between rows of elements. The document leaves open which come first
/// where the number of patches is limited, and what the large patches at the start are. First comes the patch
/// with the largest area times incoherence (form_factors/scene_views.hpp): the sum of these measures the mean
/// error of T E for a small light anywhere, which one side of T is averaged over. Of several starts, the
/// faces themselves and uniform meshes of k/4, k/2, 3k/4 and k patches, the one that ends with the smallest
/// sum is taken: halving alone reaches some numbers of square patches only. At most k patches; the elements
/// themselves if they are no more. Empty if the faces alone are more than k, or if nothing is known of the
/// scene.
std::optional<CoarseMesh> coherent_coarse_mesh(const PatchMesh& elements, Index k, Assignment assignment,
                                               const CoherentMeshOptions& options = {});

}  // namespace radiosity
