#include "frame/frame_mesh.hpp"

#include "render/shared_corners.hpp"
#include "scene/gather_weights.hpp"

namespace radiosity {
namespace {

/// Without what to gather.
FrameMesh triangles_of(const PatchMesh& mesh, const SharedCorners& corners) {
  FrameMesh result;
  result.position.resize(3, corners.count());
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const int count = mesh.patches[static_cast<std::size_t>(i)].corner_count;
    const auto vertex = [&](int k) { return static_cast<std::uint32_t>(corners.of(i, k)); };
    for (int k = 0; k < count; ++k) result.position.col(corners.of(i, k)) = mesh.corner(i, k);
    for (int k = 2; k < count; ++k) {
      result.triangles.push_back({vertex(0), vertex(k - 1), vertex(k)});
      result.patch_of_triangle.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return result;
}

/// The patches around each vertex.
std::vector<std::vector<Index>> patches_at(const PatchMesh& mesh, const SharedCorners& corners) {
  std::vector<std::vector<Index>> around(static_cast<std::size_t>(corners.count()));
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k)
      around[static_cast<std::size_t>(corners.of(i, k))].push_back(i);
  return around;
}

void add_gathered(FrameMesh& mesh, Index patch, double weight) {
  mesh.gather_patch.push_back(static_cast<std::uint32_t>(patch));
  mesh.gather_weight.push_back(static_cast<float>(weight));
}

void end_vertex(FrameMesh& mesh) {
  mesh.gather_begin.push_back(static_cast<std::uint32_t>(mesh.gather_patch.size()));
}

}  // namespace

FrameMesh frame_mesh(const PatchMesh& mesh) {
  const SharedCorners corners(mesh);
  FrameMesh result = triangles_of(mesh, corners);
  result.gather_begin.push_back(0);
  for (const std::vector<Index>& patches : patches_at(mesh, corners)) {
    double area = 0;
    for (const Index patch : patches) area += mesh.area[patch];
    for (const Index patch : patches) add_gathered(result, patch, mesh.area[patch] / area);
    end_vertex(result);
  }
  return result;
}

FrameMesh frame_mesh(const SimplifiedScene& simplified, const PatchMesh& original) {
  const SharedCorners corners(original);
  FrameMesh result = triangles_of(original, corners);
  const GatherSearch search(*simplified.mesh, simplified.grid);
  result.gather_begin.push_back(0);
  const auto around = patches_at(original, corners);
  for (std::size_t vertex = 0; vertex < around.size(); ++vertex) {
    const GatherWeights weights = search.at(result.position.col(static_cast<Index>(vertex)),
                                            original.normal.col(around[vertex].front()));
    for (std::size_t k = 0; k < weights.patches.size(); ++k)
      if (weights.weights[k] > 0) add_gathered(result, weights.patches[k], weights.weights[k]);
    end_vertex(result);
  }
  return result;
}

Eigen::Matrix3Xd blocking_triangles(const Scene& scene) {
  std::vector<Vector3> corners;
  for (const Face& face : scene.faces)
    for (int k = 2; k < face.corner_count; ++k)
      for (const int of_triangle : {0, k - 1, k}) corners.push_back(corner(scene, face, of_triangle));
  Eigen::Matrix3Xd result(3, static_cast<Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) result.col(static_cast<Index>(i)) = corners[i];
  return result;
}

}  // namespace radiosity
