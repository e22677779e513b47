#include "operators/patch_planes.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace radiosity {
namespace {

PlacedSet on_a_line(Index n) {
  PlacedSet set;
  set.items.resize(static_cast<std::size_t>(n));
  set.places = Eigen::Matrix2Xd::Constant(2, n, 0.5);
  for (Index i = 0; i < n; ++i) {
    set.items[static_cast<std::size_t>(i)] = i;
    set.places(0, i) = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
  }
  set.aspect = std::numeric_limits<double>::infinity();
  return set;
}

/// Patches of a plane have the same key: group, normal and distance from the origin, to a millionth.
using PlaneKey = std::array<long, 5>;

PlaneKey plane_of(const PatchMesh& mesh, Index patch, double size) {
  constexpr double steps = 1e6;
  const Vector3 normal = mesh.normal.col(patch);
  const double distance = normal.dot(mesh.centroid.col(patch)) / size;
  return {mesh.patches[static_cast<std::size_t>(patch)].group, std::lround(steps * normal[0]),
          std::lround(steps * normal[1]), std::lround(steps * normal[2]), std::lround(steps * distance)};
}

/// Two directions in a plane: along its first patch's first edge, so that grids lie along the axes.
Eigen::Matrix<double, 3, 2> axes_of(const PatchMesh& mesh, Index patch) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = (mesh.corner(patch, 1) - mesh.corner(patch, 0)).normalized();
  axes.col(1) = mesh.normal.col(patch).cross(Vector3(axes.col(0)));
  return axes;
}

/// The places of the patches in the rectangle that their corners span.
PlacedSet placed(const PatchMesh& mesh, const std::vector<Index>& patches) {
  const auto axes = axes_of(mesh, patches.front());
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Index patch : patches)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(patch)].corner_count; ++k) {
      const Eigen::Vector2d corner = axes.transpose() * mesh.corner(patch, k);
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  PlacedSet set;
  set.items = patches;
  set.aspect = (high - low)[0] / (high - low)[1];
  set.places = (high - low).cwiseInverse().asDiagonal() *
               ((axes.transpose() * mesh.centroid(Eigen::all, patches)).colwise() - low);
  return set;
}

}  // namespace

std::vector<PlacedSet> patch_planes(const PatchMesh& mesh) {
  const Index n = mesh.patch_count();
  if (n == 0) return {};
  if (mesh.centroid.cols() != n || mesh.normal.cols() != n || mesh.vertices.empty()) return {on_a_line(n)};
  const double size = mesh.centroid.cwiseAbs().maxCoeff();
  std::map<PlaneKey, std::vector<Index>> planes;
  for (Index i = 0; i < n; ++i) planes[plane_of(mesh, i, size > 0 ? size : 1)].push_back(i);
  std::vector<PlacedSet> sets;
  sets.reserve(planes.size());
  for (const auto& [key, patches] : planes) sets.push_back(placed(mesh, patches));
  return sets;
}

}  // namespace radiosity
