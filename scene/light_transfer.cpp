#include "scene/light_transfer.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/gather_weights.hpp"

namespace radiosity {
namespace {

constexpr std::size_t kGrain = 256;

void check_rows(const SimplifiedScene& simplified, const Eigen::MatrixXd& field) {
  if (field.rows() != simplified.mesh->patch_count())
    fail<UsageError>("a field of {} rows cannot be pulled back from {} patches", field.rows(),
                     simplified.mesh->patch_count());
}

}  // namespace

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
