#include "apps/memory_need.hpp"

#include "foundation/parallel.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// Whether a corner of patch j lies in front of the plane of patch i; `slack` is a length.
bool reaches_front(const PatchMesh& mesh, Index i, Index j, double slack) {
  const Patch& other = mesh.patches[static_cast<std::size_t>(j)];
  for (int k = 0; k < other.corner_count; ++k)
    if (mesh.normal.col(i).dot(mesh.corner(j, k) - mesh.centroid.col(i)) > slack) return true;
  return false;
}

/// The patches of each coarse face that has any.
std::vector<std::vector<Index>> patches_by_face(const PatchMesh& mesh) {
  std::map<int, std::vector<Index>> faces;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    faces[mesh.patches[static_cast<std::size_t>(i)].face].push_back(i);
  std::vector<std::vector<Index>> lists;
  lists.reserve(faces.size());
  for (auto& [face, patches] : faces) lists.push_back(std::move(patches));
  return lists;
}

/// How many of `others` reach the front of the plane of patch i.
std::uint64_t count_in_front(const PatchMesh& mesh, Index i, const std::vector<Index>& others, double slack) {
  return static_cast<std::uint64_t>(
      std::count_if(others.begin(), others.end(), [&](Index j) { return reaches_front(mesh, i, j, slack); }));
}

double tiled_entries(Index n) {
  const Index tile_rows = (n + SymmetricTiles<double>::tile_size - 1) / SymmetricTiles<double>::tile_size;
  return 0.5 * static_cast<double>(tile_rows) * static_cast<double>(tile_rows + 1) *
         static_cast<double>(SymmetricTiles<double>::tile_entries);
}

}  // namespace

double form_factor_bytes(Index patch_count, FormFactorMethod method) {
  const auto n = static_cast<double>(patch_count);
  return method == FormFactorMethod::gather ? 8 * n * n : 8 * tiled_entries(patch_count);
}

std::uint64_t facing_pairs(const PatchMesh& mesh) {
  const double slack =
      1e-9 * (mesh.centroid.rowwise().maxCoeff() - mesh.centroid.rowwise().minCoeff()).norm();
  const std::vector<std::vector<Index>> faces = patches_by_face(mesh);
  std::vector<std::uint64_t> counts(faces.size(), 0);
  parallel_for(faces.size(), [&](std::size_t a) {
    // Faces are planar: which patches of one are in front of another does not depend on the other's patch.
    for (std::size_t b = a + 1; b < faces.size(); ++b)
      if (const std::uint64_t seen = count_in_front(mesh, faces[a].front(), faces[b], slack); seen > 0)
        counts[a] += seen * count_in_front(mesh, faces[b].front(), faces[a], slack);
  });
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::vector<MemoryNeed> memory_needs(const PatchMesh& mesh) {
  const double tiled = tiled_entries(mesh.patch_count());
  const double entries = 2 * static_cast<double>(facing_pairs(mesh));
  const double rows = 8 * static_cast<double>(mesh.patch_count() + 1);
  return {{"dense:f64", 8 * tiled},
          {"dense:f32", 4 * tiled},
          {"dense:f16", 2 * tiled},
          {"csr:f64", 12 * entries + rows},
          {"csr:f32", 8 * entries + rows}};
}

}  // namespace radiosity
