#include "experiments/low_rank_radiosity/patch_drawing.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "render/camera_rays.hpp"
#include "render/image_file.hpp"
#include "render/patch_rays.hpp"
#include "render/tone_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace radiosity {
namespace {

constexpr int samples_a_side = 3;  // of a pixel

Camera camera_of(const PatchMesh& mesh) {
  return mesh.scene && mesh.scene->camera ? *mesh.scene->camera : default_camera(mesh);
}

/// The patch at each sample of a picture, -1 where there is none.
class PatchRaster {
 public:
  PatchRaster(const PatchMesh& mesh, const PatchDrawingOptions& options, Monitor& monitor)
      : width_(samples_a_side * options.width), height_(samples_a_side * options.height) {
    patches_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    const CameraRays camera(camera_of(mesh), width_, height_);
    const PatchRays rays(mesh);
    parallel_for(static_cast<std::size_t>(height_), [&](std::size_t y) {
      monitor.checkpoint("drawing patches", 0);
      for (int x = 0; x < width_; ++x) {
        const Vector3 direction = camera.direction(x + 0.5, static_cast<double>(y) + 0.5);
        patches_[y * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] =
            static_cast<std::int32_t>(rays.first_front(camera.origin(), direction).patch);
      }
    });
  }

  std::int32_t patch(int x, int y) const {
    return patches_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x)];
  }

  /// Whether another patch lies at most `reach` samples to the right or below.
  bool on_border(int x, int y, int reach) const {
    for (int step = 1; step <= reach; ++step) {
      if (x + step < width_ && patch(x + step, y) != patch(x, y)) return true;
      if (y + step < height_ && patch(x, y + step) != patch(x, y)) return true;
    }
    return false;
  }

 private:
  int width_, height_;
  std::vector<std::int32_t> patches_;
};

}  // namespace

Picture draw_patches(const PatchMesh& mesh, const Eigen::MatrixXd& colours,
                     const PatchDrawingOptions& options, Monitor& monitor) {
  if (colours.rows() != mesh.patch_count() || colours.cols() != 3)
    fail<UsageError>("a drawing needs colours of {} x 3, not {} x {}", mesh.patch_count(), colours.rows(),
                     colours.cols());
  if (options.width < 1 || options.height < 1 || !(options.line_width >= 0))
    fail<UsageError>("a drawing of {} x {} pixels with lines of {} is out of range", options.width,
                     options.height, options.line_width);
  const Color line = Color::Constant(0.01), paper = Color::Ones();
  const PatchRaster raster(mesh, options, monitor);
  const int reach = static_cast<int>(std::lround(samples_a_side * options.line_width));
  Picture picture{options.width, options.height, {}};
  picture.pixels.resize(3 * static_cast<std::size_t>(options.width) *
                        static_cast<std::size_t>(options.height));
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      Color sum = Color::Zero();
      for (int k = 0; k < samples_a_side * samples_a_side; ++k) {
        const int row = k / samples_a_side;
        const int sample_x = samples_a_side * x + k % samples_a_side, sample_y = samples_a_side * y + row;
        const std::int32_t patch = raster.patch(sample_x, sample_y);
        if (raster.on_border(sample_x, sample_y, reach))
          sum += line;
        else
          sum += patch < 0 ? paper : Color(colours.row(patch).transpose().array());
      }
      for (int c = 0; c < 3; ++c)
        picture.pixel(x, y)[c] = static_cast<float>(sum[c] / (samples_a_side * samples_a_side));
    }
  return picture;
}

Eigen::MatrixXd shaded_reflectance(const PatchMesh& mesh) {
  constexpr double sideways = 0.35;  // of what is seen face on
  const Vector3 towards = [&] {
    const Camera camera = camera_of(mesh);
    return Vector3((camera.position - camera.target).normalized() + 0.4 * camera.up.normalized());
  }();
  Eigen::MatrixXd colours(mesh.patch_count(), 3);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const double shade =
        sideways + (1 - sideways) * std::clamp(mesh.normal.col(i).dot(towards.normalized()), 0.0, 1.0);
    for (Index c = 0; c < 3; ++c)
      colours(i, c) = shade * mesh.reflectance(i, std::min(c, mesh.channels() - 1));
  }
  return colours;
}

void expose_alike(std::vector<Picture>& pictures) {
  double exposure = std::numeric_limits<double>::infinity();
  for (const Picture& picture : pictures) exposure = std::min(exposure, exposure_of(picture));
  for (Picture& picture : pictures)
    for (float& number : picture.pixels) number *= static_cast<float>(exposure);
}

Picture side_by_side(const std::vector<Picture>& pictures) {
  constexpr int gap = 12;
  Picture whole;
  for (const Picture& picture : pictures) {
    if (picture.height != pictures.front().height)
      fail<UsageError>("pictures of {} and {} pixels in height do not go side by side",
                       pictures.front().height, picture.height);
    whole.width += picture.width + (whole.width > 0 ? gap : 0);
    whole.height = picture.height;
  }
  whole.pixels.assign(3 * static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height), 1);
  int left = 0;
  for (const Picture& picture : pictures) {
    for (int y = 0; y < picture.height; ++y)
      std::copy_n(picture.pixel(0, y), 3 * picture.width, whole.pixel(left, y));
    left += picture.width + gap;
  }
  return whole;
}

void write_drawing(const std::filesystem::path& file, const Picture& picture) {
  write_png(file, picture.width, picture.height, tone_mapped(picture, 1));
}

}  // namespace radiosity
