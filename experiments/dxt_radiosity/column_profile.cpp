#include "experiments/dxt_radiosity/column_profile.hpp"

#include "foundation/error.hpp"
#include "render/camera_rays.hpp"
#include "render/patch_rays.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr double aligned_cosine = 0.99;

/// Whether each patch is of that side of the group.
std::vector<bool> patches_of_side(const PatchMesh& mesh, const std::string& group, const Vector3& normal) {
  const std::vector<std::string>& groups = mesh.scene->groups;
  const auto found = std::find(groups.begin(), groups.end(), group);
  if (found == groups.end()) fail<UsageError>("'{}' has no group '{}'", mesh.scene->name, group);
  const auto number = static_cast<int>(found - groups.begin());
  std::vector<bool> on_side;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    on_side.push_back(mesh.patches[static_cast<std::size_t>(i)].group == number &&
                      mesh.normal.col(i).dot(normal) > aligned_cosine);
  return on_side;
}

struct HeightRange {
  double low = 0;
  double high = 0;
};

HeightRange heights_of(const PatchMesh& mesh, const std::vector<bool>& on_side) {
  HeightRange range{INFINITY, -INFINITY};
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    if (!on_side[static_cast<std::size_t>(i)]) continue;
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k) {
      range.low = std::min(range.low, mesh.corner(i, k).y());
      range.high = std::max(range.high, mesh.corner(i, k).y());
    }
  }
  return range;
}

}  // namespace

ColumnBands column_bands(const PatchMesh& mesh, const std::string& group, const Vector3& normal,
                         const Camera& camera, int width, int height, int bands) {
  if (bands < 2) fail<UsageError>("a profile needs two bands at least, not {}", bands);
  const std::vector<bool> on_side = patches_of_side(mesh, group, normal);
  const HeightRange range = heights_of(mesh, on_side);
  const PatchRays rays(mesh);
  const CameraRays camera_rays(camera, width, height);
  ColumnBands result;
  result.pixels.resize(static_cast<std::size_t>(bands));
  for (int band = 0; band < bands; ++band)
    result.height.push_back(range.low + (band + 0.5) / bands * (range.high - range.low));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const PatchHit hit = rays.first_front(camera_rays.origin(), camera_rays.direction(x + 0.5, y + 0.5));
      if (hit.missed() || !on_side[static_cast<std::size_t>(hit.patch)]) continue;
      const double part = (hit.point.y() - range.low) / (range.high - range.low);
      const int band = std::clamp(static_cast<int>(part * bands), 0, bands - 1);
      result.pixels[static_cast<std::size_t>(band)].push_back(
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
  for (int band = 0; band < bands; ++band)
    if (result.pixels[static_cast<std::size_t>(band)].empty())
      fail<UsageError>("no pixel sees band {} of {} of '{}': the picture is too small, or it is hidden",
                       band + 1, bands, group);
  return result;
}

Eigen::MatrixX3d profile_of(const Picture& picture, const ColumnBands& bands) {
  Eigen::MatrixX3d profile = Eigen::MatrixX3d::Zero(static_cast<Index>(bands.height.size()), 3);
  for (Index band = 0; band < profile.rows(); ++band) {
    const std::vector<std::size_t>& pixels = bands.pixels[static_cast<std::size_t>(band)];
    for (const std::size_t pixel : pixels)
      for (int c = 0; c < 3; ++c)
        profile(band, c) += static_cast<double>(picture.pixels[3 * pixel + static_cast<std::size_t>(c)]);
    profile.row(band) /= static_cast<double>(pixels.size());
  }
  return profile;
}

double colour_gradient(const ColumnBands& bands, const Eigen::MatrixX3d& profile) {
  const Eigen::ArrayXd red = profile.col(0).array() / profile.rowwise().sum().array();
  const Eigen::Map<const Eigen::ArrayXd> height(bands.height.data(), red.size());
  const Eigen::ArrayXd apart = height - height.mean();
  return (apart * (red - red.mean())).sum() / apart.square().sum();
}

Eigen::Array3d profile_error(const Eigen::MatrixX3d& profile, const Eigen::MatrixX3d& reference) {
  const Eigen::Array3d squares = (profile - reference).colwise().squaredNorm().transpose().array();
  return (squares / static_cast<double>(profile.rows())).sqrt() /
         reference.colwise().mean().transpose().array();
}

}  // namespace radiosity
