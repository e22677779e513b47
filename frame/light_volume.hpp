#pragma once

#include "scene/scene.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <vector>

namespace radiosity {

/// Light propagation volumes (Kaplanyan, Dachsbacher 2010, "Cascaded Light Propagation Volumes for Real-Time
/// Indirect Illumination"): a grid of cubes that keep radiant intensity, W/sr, as spherical harmonics of
/// orders 0 and 1, and hand it on to their neighbours. Surfaces are known by how much of a cell's face they
/// cover.
class LightVolume {
 public:
  /// A grid over the box and a cell beyond it on every side, its cells a `cells`-th of the longest edge of
  /// the box wide. Throws UsageError for less than 2 or more than 256 cells, and for an empty box.
  LightVolume(const Eigen::AlignedBox3d& box, int cells);

  double cell() const { return cell_; }  ///< edge, scene units
  const std::array<int, 3>& cells() const { return cells_; }

  /// A piece of surface of that area, in square scene units, stops what arrives at its front. Kept in the
  /// corners of cells.
  void add_surface(const Vector3& point, const Vector3& normal, double area);
  /// A piece of surface reflects that flux, W, by the cosine law. Light starts half a cell above it.
  void add_light(const Vector3& point, const Vector3& normal, const Color& flux);
  /// Forgets all light.
  void darken();

  /// So many times from cell to neighbour. A cell gives each neighbour what it sends to the five far faces of
  /// it, scaled so that a cell sends the flux that it has; the neighbour radiates it towards these faces.
  void propagate(int steps);

  /// What a surface there receives of the light that has passed, W/m^2, without what was added there itself.
  /// As much as goes through the face of a cell, over its area; the paper takes the intensity half a cell
  /// away, which is 1.9 times as much.
  Color irradiance(const Vector3& point, const Vector3& normal) const;

  /// Of the light that is on its way, W.
  Color flux() const;

 private:
  /// Coefficients of the harmonics by colour.
  using Intensity = Eigen::Matrix<double, 4, 3>;

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_[0]) +
           static_cast<std::size_t>(x);
  }
  std::size_t corner(int x, int y, int z) const;
  /// In cells from the low corner of the grid.
  Vector3 place(const Vector3& point) const { return (point - low_) / cell_; }
  bool inside(const std::array<int, 3>& cell) const;
  /// What surfaces in the face between a cell and its neighbour `side` leave of light in a direction.
  double passed(const std::array<int, 3>& cell, int side, const Eigen::Vector4d& direction) const;
  Intensity gathered(const std::array<int, 3>& cell, const std::vector<Eigen::Array3d>& scale) const;

  Vector3 low_;
  double cell_ = 1;
  std::array<int, 3> cells_{};
  std::vector<Eigen::Vector4d> covered_;  ///< a corner each, parts of a face
  std::vector<Intensity> travelling_;     ///< a cell each
  std::vector<Intensity> passed_;         ///< sum over all steps
};

}  // namespace radiosity
