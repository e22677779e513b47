#include "scene/light_transfer.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/gather_weights.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace radiosity {
namespace {

constexpr std::size_t kGrain = 256;

void check_rows(const SimplifiedScene& simplified, const Eigen::MatrixXd& field) {
  if (field.rows() != simplified.mesh->patch_count())
    fail<UsageError>("a field of {} rows cannot be pulled back from {} patches", field.rows(),
                     simplified.mesh->patch_count());
}

/// The keys of all quads, rising: the k-th quad is the k-th face of the simplified scene.
std::vector<std::uint64_t> quad_keys(const std::vector<VoxelFragment>& fragments) {
  std::vector<std::uint64_t> keys;
  keys.reserve(fragments.size());
  for (const VoxelFragment& fragment : fragments) keys.push_back(quad_key(fragment));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace

Eigen::MatrixXd sum_over_fragments(const SimplifiedScene& simplified, const PatchMesh& original,
                                   const Eigen::MatrixXd& field) {
  if (field.rows() != original.patch_count())
    fail<UsageError>("a field of {} rows cannot be summed over {} patches", field.rows(),
                     original.patch_count());
  const std::vector<std::uint64_t> keys = quad_keys(simplified.fragments);
  Eigen::MatrixXd of_faces = Eigen::MatrixXd::Zero(static_cast<Index>(keys.size()), field.cols());
  for (const VoxelFragment& fragment : simplified.fragments) {
    const auto face = std::lower_bound(keys.begin(), keys.end(), quad_key(fragment)) - keys.begin();
    of_faces.row(face) += fragment.area * field.row(fragment.patch);
  }
  Eigen::MatrixXd sums(simplified.mesh->patch_count(), field.cols());
  for (Index i = 0; i < sums.rows(); ++i)
    sums.row(i) = of_faces.row(simplified.mesh->patches[static_cast<std::size_t>(i)].face);
  return sums;
}

Eigen::MatrixXd pull_back_to_patches(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& field) {
  check_rows(simplified, field);
  const GatherSearch search(*simplified.mesh, simplified.grid);
  const std::vector<VoxelFragment>& fragments = simplified.fragments;
  Eigen::MatrixXd gathered(static_cast<Index>(fragments.size()), field.cols());
  parallel_for(
      fragments.size(),
      [&](std::size_t f) {
        const Vector3 normal = original.normal.col(fragments[f].patch);
        gathered.row(static_cast<Index>(f)) = search.at(fragments[f].centroid, normal).mean(field);
      },
      kGrain);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(original.patch_count(), field.cols());
  Eigen::VectorXd area = Eigen::VectorXd::Zero(original.patch_count());
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    result.row(fragments[f].patch) += fragments[f].area * gathered.row(static_cast<Index>(f));
    area[fragments[f].patch] += fragments[f].area;
  }
  result.array().colwise() /= area.array();
  return result;
}

Eigen::MatrixXd pull_back_to_corners(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& field) {
  check_rows(simplified, field);
  const GatherSearch search(*simplified.mesh, simplified.grid);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(4 * original.patch_count(), field.cols());
  parallel_for(
      original.patches.size(),
      [&](std::size_t i) {
        const auto patch = static_cast<Index>(i);
        for (int k = 0; k < original.patches[i].corner_count; ++k)
          result.row(4 * patch + k) =
              search.at(original.corner(patch, k), original.normal.col(patch)).mean(field);
      },
      kGrain);
  return result;
}

Eigen::MatrixXd radiosity_of_patches(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& irradiance) {
  return original.emission +
         original.reflectance.cwiseProduct(pull_back_to_patches(simplified, original, irradiance));
}

Eigen::MatrixXd radiosity_of_corners(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& irradiance) {
  Eigen::MatrixXd B = pull_back_to_corners(simplified, original, irradiance);
  for (Index row = 0; row < B.rows(); ++row)
    B.row(row) = original.emission.row(row / 4) + original.reflectance.row(row / 4).cwiseProduct(B.row(row));
  return B;
}

}  // namespace radiosity
