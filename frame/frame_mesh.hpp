#pragma once

#include "scene/voxel_simplification.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace radiosity {

/// The patches that a frame shows, as triangles whose vertices each take the weighted mean of the light of
/// some of the patches that were solved on (document 000, section 3.6, step 4).
struct FrameMesh {
  Eigen::Matrix3Xd position;                            ///< of each vertex, scene units
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertices, counter-clockwise seen from the front
  std::vector<std::uint32_t> patch_of_triangle;         ///< the shown patch

  /// Vertex v takes gather_patch[k] with gather_weight[k] for gather_begin[v] <= k < gather_begin[v + 1];
  /// weights sum up to 1.
  std::vector<std::uint32_t> gather_begin;
  std::vector<std::uint32_t> gather_patch;
  std::vector<float> gather_weight;
};

/// Of a mesh that is solved on itself: area-weighted means as VertexRadiosity has them.
FrameMesh frame_mesh(const PatchMesh& mesh);

/// Of the original of a simplified scene: the four patches and weights of GatherSearch.
FrameMesh frame_mesh(const SimplifiedScene& simplified, const PatchMesh& original);

/// The coarse faces, which block light, as triangles: 3 x corners, three a triangle.
Eigen::Matrix3Xd blocking_triangles(const Scene& scene);

}  // namespace radiosity
