#include "frame/emission_points.hpp"

#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "render/path_sampling.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace radiosity {
namespace {

constexpr int most_strata = 64;
constexpr std::uint64_t points_seed = 36;

EmissionPoints room_for(const PatchMesh& mesh, int strata) {
  if (strata < 1 || strata > most_strata)
    fail<UsageError>("{} x {} points on a patch are out of range; 1 to {} each way are possible", strata,
                     strata, most_strata);
  EmissionPoints points;
  points.per_patch = Index{strata} * strata;
  points.position.resize(3, mesh.patch_count() * points.per_patch);
  points.normal.resize(3, mesh.patch_count() * points.per_patch);
  points.reflectance = in_three_columns(mesh.reflectance);
  points.emission = in_three_columns(mesh.emission);
  return points;
}

/// The fragments of each quad, quads in their order.
std::vector<std::vector<const VoxelFragment*>> fragments_of_quads(
    const std::vector<VoxelFragment>& fragments) {
  std::vector<std::uint64_t> keys;
  keys.reserve(fragments.size());
  for (const VoxelFragment& fragment : fragments) keys.push_back(quad_key(fragment));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<std::vector<const VoxelFragment*>> quads(keys.size());
  for (const VoxelFragment& fragment : fragments)
    quads[static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), quad_key(fragment)) -
                                   keys.begin())]
        .push_back(&fragment);
  return quads;
}

double total_area(const std::vector<const VoxelFragment*>& fragments) {
  double area = 0;
  for (const VoxelFragment* fragment : fragments) area += fragment->area;
  return area;
}

}  // namespace

Eigen::MatrixXd in_three_columns(const Eigen::MatrixXd& field) {
  if (field.cols() != 1 && field.cols() != 3)
    fail<UsageError>("a frame has 1 or 3 channels, not {}", field.cols());
  return field.cols() == 3 ? field : Eigen::MatrixXd(field.replicate(1, 3));
}

EmissionPoints emission_points(const PatchMesh& mesh, int strata) {
  EmissionPoints points = room_for(mesh, strata);
  for (Index patch = 0; patch < mesh.patch_count(); ++patch) {
    RandomStream random(points_seed, static_cast<std::uint64_t>(patch));
    for (Index k = 0; k < points.per_patch; ++k) {
      const Index row = k / strata;
      const Index column = k % strata;
      const double u = (static_cast<double>(row) + random.uniform()) / strata;
      const double v = (static_cast<double>(column) + random.uniform()) / strata;
      points.position.col(patch * points.per_patch + k) = point_on_patch(mesh, patch, u, v);
      points.normal.col(patch * points.per_patch + k) = mesh.normal.col(patch);
    }
  }
  return points;
}

EmissionPoints emission_points(const SimplifiedScene& simplified, const PatchMesh& original, int strata) {
  const PatchMesh& mesh = *simplified.mesh;
  EmissionPoints points = room_for(mesh, strata);
  const auto quads = fragments_of_quads(simplified.fragments);
  for (Index patch = 0; patch < mesh.patch_count(); ++patch) {
    const auto& fragments =
        quads[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(patch)].face)];
    const double area = total_area(fragments);
    std::size_t at = 0;
    double until = fragments.front()->area;
    for (Index k = 0; k < points.per_patch; ++k) {
      const double wanted = area * (static_cast<double>(k) + 0.5) / static_cast<double>(points.per_patch);
      while (until < wanted && at + 1 < fragments.size()) until += fragments[++at]->area;
      points.position.col(patch * points.per_patch + k) = fragments[at]->centroid;
      points.normal.col(patch * points.per_patch + k) = original.normal.col(fragments[at]->patch);
    }
    points.reflectance.row(patch) *= area / mesh.area[patch];
  }
  return points;
}

}  // namespace radiosity
