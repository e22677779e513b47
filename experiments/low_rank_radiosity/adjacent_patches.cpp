#include "experiments/low_rank_radiosity/adjacent_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

constexpr double largest_cosine_between_planes = 1 - 1e-9;

struct Edge {
  Vector3 begin;
  Vector3 end;
};

Edge edge_of(const PatchMesh& mesh, Index patch, int k) {
  const int count = mesh.patches[static_cast<std::size_t>(patch)].corner_count;
  return {mesh.corner(patch, k), mesh.corner(patch, (k + 1) % count)};
}

/// Whether two segments lie on one line and overlap.
bool edges_overlap(const Edge& a, const Edge& b, double tolerance) {
  const Vector3 along = a.end - a.begin;
  const double length = along.norm();
  const double shorter = std::min(length, (b.end - b.begin).norm());
  if (shorter == 0) return false;
  const Vector3 direction = along / length;
  const std::array<Vector3, 2> offsets = {b.begin - a.begin, b.end - a.begin};
  std::array<double, 2> places{};
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    places[k] = direction.dot(offsets[k]);
    if ((offsets[k] - places[k] * direction).norm() > tolerance * shorter) return false;
  }
  const auto [low, high] = std::minmax(places[0], places[1]);
  return std::min(high, length) - std::max(low, 0.0) > tolerance * shorter;
}

bool share_an_edge(const PatchMesh& mesh, Index i, Index j, double tolerance) {
  for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k)
    for (int l = 0; l < mesh.patches[static_cast<std::size_t>(j)].corner_count; ++l)
      if (edges_overlap(edge_of(mesh, i, k), edge_of(mesh, j, l), tolerance)) return true;
  return false;
}

/// The largest distance of a corner from the centroid, of each patch.
Eigen::VectorXd patch_radii(const PatchMesh& mesh) {
  Eigen::VectorXd radii = Eigen::VectorXd::Zero(mesh.patch_count());
  for (Index i = 0; i < radii.size(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k)
      radii[i] = std::max(radii[i], (mesh.corner(i, k) - mesh.centroid.col(i)).norm());
  return radii;
}

}  // namespace

std::vector<std::pair<Index, Index>> adjacent_patches(const PatchMesh& mesh, double tolerance) {
  const Eigen::VectorXd radii = patch_radii(mesh);
  std::vector<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < radii.size(); ++i)
    for (Index j = i + 1; j < radii.size(); ++j) {
      const double reach = (1 + tolerance) * (radii[i] + radii[j]);
      if ((mesh.centroid.col(i) - mesh.centroid.col(j)).squaredNorm() > reach * reach) continue;
      if (std::abs(mesh.normal.col(i).dot(mesh.normal.col(j))) > largest_cosine_between_planes) continue;
      if (share_an_edge(mesh, i, j, tolerance)) pairs.emplace_back(i, j);
    }
  return pairs;
}

}  // namespace radiosity
