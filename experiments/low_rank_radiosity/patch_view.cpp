#include "experiments/low_rank_radiosity/patch_view.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

constexpr int view_samples = 3;  // of a pixel, each way

/// The plane of a patch and the direction that it faces, as the axes of a picture.
struct ViewAxes {
  Vector3 right, up, forward;

  explicit ViewAxes(const Vector3& normal) : forward(normal) {
    constexpr double level = 0.99;
    const Vector3 upright =
        std::fabs(normal.y()) < level ? Vector3(Vector3::UnitY()) : Vector3(-Vector3::UnitZ());
    up = (upright - upright.dot(normal) * normal).normalized();
    right = forward.cross(up);
  }

  /// The direction seen at (u, v) of the unit disc.
  Vector3 direction(double u, double v) const {
    return u * right + v * up + std::sqrt(std::max(0.0, 1 - u * u - v * v)) * forward;
  }
};

}  // namespace

Picture draw_view(const PatchMesh& mesh, const PatchRays& rays, Index patch, const Eigen::MatrixXd& B,
                  double exposure, int size, Monitor& monitor) {
  const ViewAxes axes(mesh.normal.col(patch));
  const Vector3 middle = mesh.centroid.col(patch);
  const auto screen_colour = [&](double u, double v) -> Color {
    if (u * u + v * v >= 1) return Color::Ones();
    const PatchHit hit = rays.from_patch(patch, middle, axes.direction(u, v));
    if (hit.missed() || !hit.front) return Color::Zero();
    const double scale = exposure / std::numbers::pi;
    Color colour;
    for (Index c = 0; c < 3; ++c)
      colour[c] = std::clamp(scale * B(hit.patch, std::min(c, B.cols() - 1)), 0.0, 1.0);
    return colour;
  };

  Picture picture{size, size, {}};
  picture.pixels.resize(3 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  parallel_for(static_cast<std::size_t>(size), [&](std::size_t row) {
    monitor.checkpoint("drawing views", 0);
    const auto y = static_cast<int>(row);
    for (int x = 0; x < size; ++x) {
      Color sum = Color::Zero();
      for (int k = 0; k < view_samples * view_samples; ++k) {
        const int sample_row = k / view_samples;
        const double across = x + (k % view_samples + 0.5) / view_samples;
        const double down = y + (sample_row + 0.5) / view_samples;
        sum += screen_colour(2 * across / size - 1, 1 - 2 * down / size);
      }
      for (int c = 0; c < 3; ++c)
        picture.pixel(x, y)[c] = static_cast<float>(sum[c] / (view_samples * view_samples));
    }
  });
  return picture;
}

}  // namespace radiosity
