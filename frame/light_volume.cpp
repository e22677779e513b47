#include "frame/light_volume.hpp"

#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "foundation/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

constexpr int most_cells_of_edge = 256;
constexpr int axes = 3;
constexpr int sides = 6;  ///< number 2 axis is the low one, 2 axis + 1 the high one

/// The harmonics in a direction: their product with coefficients is the intensity there.
Eigen::Vector4d harmonics(const Vector3& direction) {
  const double constant = std::sqrt(1 / (4 * std::numbers::pi));
  const double linear = std::sqrt(3 / (4 * std::numbers::pi));
  return {constant, linear * direction.x(), linear * direction.y(), linear * direction.z()};
}

/// Coefficients of the positive part of the cosine with a direction, whose flux is pi.
Eigen::Vector4d cosine_lobe(const Vector3& direction) {
  const double constant = std::sqrt(std::numbers::pi) / 2;
  const double linear = std::sqrt(std::numbers::pi / 3);
  return {constant, linear * direction.x(), linear * direction.y(), linear * direction.z()};
}

Vector3 direction_of(int side) {
  return (side % 2 == 0 ? -1 : 1) * Vector3::Unit(side / 2);
}

int opposite(int side) {
  return side ^ 1;
}

/// How a face of a neighbour is seen from the middle of a cell.
struct SeenFace {
  double solid_angle = 0;     ///< 0: the one between them
  Eigen::Vector4d direction;  ///< harmonics towards its middle
  Eigen::Vector4d lobe;       ///< with which the neighbour sends a watt towards it, W/sr
};

/// Of a square of unit edge at that distance along its normal.
double solid_angle_ahead(double distance) {
  constexpr double half = 0.5;
  return 4 * std::asin(half * half / (half * half + distance * distance));
}

using SeenFaces = std::array<std::array<SeenFace, sides>, sides>;  ///< by side of the neighbour, by its face

SeenFaces see_faces() {
  constexpr double farthest = 1.5;
  const double ahead = solid_angle_ahead(farthest);
  // The six neighbours together fill the sphere.
  const double beside = (4 * std::numbers::pi / sides - ahead) / 4;
  SeenFaces faces;
  for (int side = 0; side < sides; ++side)
    for (int face = 0; face < sides; ++face) {
      if (face == opposite(side)) continue;
      const Vector3 middle = direction_of(side) + 0.5 * direction_of(face);
      faces[static_cast<std::size_t>(side)][static_cast<std::size_t>(face)] = {
          face == side ? ahead : beside, harmonics(middle.normalized()),
          cosine_lobe(direction_of(face)) / std::numbers::pi};
    }
  return faces;
}

const SeenFaces& seen_faces() {
  static const SeenFaces faces = see_faces();
  return faces;
}

double flux_of(const Eigen::Vector4d& coefficients) {
  return coefficients[0] * std::sqrt(4 * std::numbers::pi);
}

/// With which what a cell sends to the faces of its neighbours is the flux that it has.
Eigen::Array3d scale_of_flux(const Eigen::Matrix<double, 4, 3>& intensity) {
  Eigen::Array3d sent = Eigen::Array3d::Zero();
  for (const auto& faces : seen_faces())
    for (const SeenFace& face : faces)
      if (face.solid_angle > 0)
        sent += face.solid_angle * (intensity.transpose() * face.direction).array().max(0.0);
  Eigen::Array3d scale = Eigen::Array3d::Zero();
  for (int c = 0; c < 3; ++c)
    if (sent[c] > 0) scale[c] = std::max(0.0, flux_of(intensity.col(c))) / sent[c];
  return scale;
}

std::array<int, 3> neighbour(std::array<int, 3> cell, int side) {
  cell[static_cast<std::size_t>(side / 2)] += side % 2 == 0 ? -1 : 1;
  return cell;
}

}  // namespace

LightVolume::LightVolume(const Eigen::AlignedBox3d& box, int cells) {
  if (cells < 2 || cells > most_cells_of_edge)
    fail<UsageError>(
        "a light propagation volume of {} cells along its longest edge is out of range; 2 to {} are "
        "possible",
        cells, most_cells_of_edge);
  if (box.isEmpty() || !(box.sizes().maxCoeff() > 0))
    fail<UsageError>("a light propagation volume needs a scene that is larger than a point");
  cell_ = box.sizes().maxCoeff() / cells;
  low_ = box.min() - Vector3::Constant(cell_);
  std::size_t count = 1;
  std::size_t corners = 1;
  for (int axis = 0; axis < axes; ++axis) {
    // The longest edge has its cells, and not one more where division rounds.
    const double along = std::ceil(box.sizes()[axis] / cell_ - 1e-9);
    cells_[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(along)) + 2;
    count *= static_cast<std::size_t>(cells_[static_cast<std::size_t>(axis)]);
    corners *= static_cast<std::size_t>(cells_[static_cast<std::size_t>(axis)]) + 1;
  }
  const std::size_t of_cell = 3 * sizeof(Intensity) + sizeof(Eigen::Array3d);
  require_available_memory(
      fmt::format("a light propagation volume of {} x {} x {} cells", cells_[0], cells_[1], cells_[2]),
      static_cast<double>(count * of_cell + corners * sizeof(Eigen::Vector4d)), "take fewer cells");
  covered_.assign(corners, Eigen::Vector4d::Zero());
  travelling_.assign(count, Intensity::Zero());
  passed_.assign(count, Intensity::Zero());
}

std::size_t LightVolume::corner(int x, int y, int z) const {
  const auto across = static_cast<std::size_t>(cells_[0]) + 1;
  const auto up = static_cast<std::size_t>(cells_[1]) + 1;
  return (static_cast<std::size_t>(z) * up + static_cast<std::size_t>(y)) * across +
         static_cast<std::size_t>(x);
}

bool LightVolume::inside(const std::array<int, 3>& cell) const {
  for (std::size_t axis = 0; axis < cell.size(); ++axis)
    if (cell[axis] < 0 || cell[axis] >= cells_[axis]) return false;
  return true;
}

void LightVolume::add_surface(const Vector3& point, const Vector3& normal, double area) {
  const Vector3 at = place(point);
  std::array<int, 3> nearest{};
  for (int axis = 0; axis < axes; ++axis)
    nearest[static_cast<std::size_t>(axis)] =
        std::clamp(static_cast<int>(std::lround(at[axis])), 0, cells_[static_cast<std::size_t>(axis)]);
  covered_[corner(nearest[0], nearest[1], nearest[2])] += area / (cell_ * cell_) * cosine_lobe(-normal);
}

void LightVolume::add_light(const Vector3& point, const Vector3& normal, const Color& flux) {
  const Vector3 at = place(point) + 0.5 * normal;
  std::array<int, 3> cell{};
  for (int axis = 0; axis < axes; ++axis)
    cell[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(at[axis]));
  if (!inside(cell)) return;
  travelling_[index(cell[0], cell[1], cell[2])] +=
      cosine_lobe(normal) * (flux / std::numbers::pi).matrix().transpose();
}

void LightVolume::darken() {
  std::fill(travelling_.begin(), travelling_.end(), Intensity::Zero());
  std::fill(passed_.begin(), passed_.end(), Intensity::Zero());
}

double LightVolume::passed(const std::array<int, 3>& cell, int side, const Eigen::Vector4d& direction) const {
  const auto axis = static_cast<std::size_t>(side / 2);
  std::array<int, 3> at = cell;
  at[axis] += side % 2;
  const std::size_t first = (axis + 1) % 3;
  const std::size_t second = (axis + 2) % 3;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int k = 0; k < 4; ++k) {
    std::array<int, 3> of_face = at;
    of_face[first] += k % 2;
    of_face[second] += k / 2;
    sum += covered_[corner(of_face[0], of_face[1], of_face[2])];
  }
  return 1 - std::clamp(0.25 * sum.dot(direction), 0.0, 1.0);
}

LightVolume::Intensity LightVolume::gathered(const std::array<int, 3>& cell,
                                             const std::vector<Eigen::Array3d>& scale) const {
  Intensity sum = Intensity::Zero();
  for (int side = 0; side < sides; ++side) {  // this cell is that neighbour of the one that sends
    const std::array<int, 3> from = neighbour(cell, opposite(side));
    if (!inside(from)) continue;
    const std::size_t source = index(from[0], from[1], from[2]);
    if ((scale[source] == 0).all()) continue;
    for (const SeenFace& face : seen_faces()[static_cast<std::size_t>(side)]) {
      if (face.solid_angle == 0) continue;
      const Eigen::Array3d intensity =
          (travelling_[source].transpose() * face.direction).array().max(0.0) * scale[source];
      sum += face.lobe *
             (face.solid_angle * passed(from, side, face.direction) * intensity).matrix().transpose();
    }
  }
  return sum;
}

void LightVolume::propagate(int steps) {
  const auto layers = static_cast<std::size_t>(cells_[2]);
  const std::size_t of_layer = travelling_.size() / layers;
  std::vector<Eigen::Array3d> scale(travelling_.size());
  std::vector<Intensity> next(travelling_.size());
  for (int step = 0; step < steps; ++step) {
    parallel_for(layers, [&](std::size_t layer) {
      for (std::size_t cell = layer * of_layer; cell < (layer + 1) * of_layer; ++cell)
        scale[cell] = scale_of_flux(travelling_[cell]);
    });
    parallel_for(layers, [&](std::size_t layer) {
      const auto z = static_cast<int>(layer);
      for (int y = 0; y < cells_[1]; ++y)
        for (int x = 0; x < cells_[0]; ++x) {
          const std::size_t cell = index(x, y, z);
          next[cell] = gathered({x, y, z}, scale);
          passed_[cell] += next[cell];
        }
    });
    travelling_.swap(next);
  }
}

Color LightVolume::irradiance(const Vector3& point, const Vector3& normal) const {
  const Vector3 at = place(point) + 0.5 * normal - Vector3::Constant(0.5);  // in middles of cells
  const Eigen::Array3d floor = at.array().floor();
  const Eigen::Array3d part = at.array() - floor;
  Intensity sum = Intensity::Zero();
  for (int k = 0; k < 8; ++k) {
    const std::array<int, 3> step = {k % 2, k / 2 % 2, k / 4};
    std::array<int, 3> cell{};
    double weight = 1;
    for (std::size_t axis = 0; axis < step.size(); ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      cell[axis] = static_cast<int>(floor[a]) + step[axis];
      weight *= step[axis] == 1 ? part[a] : 1 - part[a];
    }
    if (inside(cell)) sum += weight * passed_[index(cell[0], cell[1], cell[2])];
  }
  constexpr double solid_angle_of_face = 4 * std::numbers::pi / sides;
  return solid_angle_of_face / (cell_ * cell_) * (sum.transpose() * harmonics(-normal)).array().max(0.0);
}

Color LightVolume::flux() const {
  Color sum = Color::Zero();
  for (const Intensity& intensity : travelling_)
    for (int c = 0; c < 3; ++c) sum[c] += flux_of(intensity.col(c));
  return sum;
}

}  // namespace radiosity
