#include "render/picture.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "render/camera_rays.hpp"
#include "render/patch_rays.hpp"
#include "render/vertex_radiosity.hpp"

#include <atomic>
#include <numbers>
#include <optional>

namespace radiosity {
namespace {

void check(const PatchMesh& mesh, const Eigen::MatrixXd& B, const Eigen::MatrixXd& corners,
           const PictureOptions& options) {
  if (B.rows() != mesh.patch_count() || (B.cols() != 1 && B.cols() != 3))
    fail<UsageError>("a picture needs a radiosity of {} x 1 or {} x 3, not {} x {}", mesh.patch_count(),
                     mesh.patch_count(), B.rows(), B.cols());
  if (corners.size() > 0 && (corners.rows() != 4 * mesh.patch_count() || corners.cols() != B.cols()))
    fail<UsageError>("the radiosity at corners is {} x {}, not {} x {}", corners.rows(), corners.cols(),
                     4 * mesh.patch_count(), B.cols());
  constexpr int largest = 16384;
  if (options.width < 1 || options.width > largest || options.height < 1 || options.height > largest)
    fail<UsageError>("a picture of {} x {} pixels is out of range; 1 to {} are possible each way",
                     options.width, options.height, largest);
  if (options.supersampling < 1 || options.supersampling > 8)
    fail<UsageError>("supersampling {} is out of range; 1 to 8 rays a pixel each way are possible",
                     options.supersampling);
}

/// B itself or interpolated from the corners, as linear RGB.
class Shading {
 public:
  Shading(const PatchMesh& mesh, const Eigen::MatrixXd& B, const Eigen::MatrixXd& corners, bool interpolate)
      : B_(B) {
    if (interpolate) corners_.emplace(mesh, corners.size() > 0 ? corners : B);
  }

  Color radiance(const PatchHit& hit) const {
    const Eigen::RowVectorXd B = corners_ ? corners_->at(hit.patch, hit.point) : B_.row(hit.patch);
    return (B.size() == 3 ? Color(B.transpose().array()) : Color::Constant(B[0])) / std::numbers::pi;
  }

 private:
  const Eigen::MatrixXd& B_;
  std::optional<VertexRadiosity> corners_;
};

}  // namespace

Picture render_picture(const PatchMesh& mesh, const Eigen::MatrixXd& B, const PictureOptions& options,
                       Monitor& monitor, const Eigen::MatrixXd& corners) {
  check(mesh, B, corners, options);
  const bool own_camera = mesh.scene && mesh.scene->camera.has_value();
  const CameraRays camera(own_camera ? *mesh.scene->camera : default_camera(mesh), options.width,
                          options.height);
  const PatchRays rays(mesh);
  const Shading shading(mesh, B, corners, options.interpolate);
  const int samples = options.supersampling;

  Picture picture{options.width, options.height, {}};
  picture.pixels.resize(3 * static_cast<std::size_t>(options.width) *
                        static_cast<std::size_t>(options.height));
  std::atomic<int> done{0};
  parallel_for(static_cast<std::size_t>(options.height), [&](std::size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < options.width; ++x) {
      Color sum = Color::Zero();
      for (int k = 0; k < samples * samples; ++k) {
        const int row_of_samples = k / samples;
        const double sample_x = x + (k % samples + 0.5) / samples;
        const double sample_y = y + (row_of_samples + 0.5) / samples;
        const PatchHit hit = rays.first_front(camera.origin(), camera.direction(sample_x, sample_y));
        if (!hit.missed()) sum += shading.radiance(hit);
      }
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = static_cast<float>(sum[c] / (samples * samples));
    }
    monitor.checkpoint("drawing", static_cast<double>(++done) / options.height);
  });
  return picture;
}

}  // namespace radiosity
