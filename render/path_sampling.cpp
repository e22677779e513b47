#include "render/path_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {

Vector3 point_on_patch(const PatchMesh& mesh, Index patch, double u, double v) {
  const Vector3& a = mesh.corner(patch, 0);
  Vector3 b = mesh.corner(patch, 1);
  Vector3 c = mesh.corner(patch, 2);
  if (mesh.patches[static_cast<std::size_t>(patch)].corner_count == 4) {
    const Vector3& d = mesh.corner(patch, 3);
    const double first = (b - a).cross(c - a).norm();
    const double second = (c - a).cross(d - a).norm();
    const double share = first / (first + second);
    if (u < share) {
      u /= share;
    } else {
      u = (u - share) / (1 - share);
      b = c;
      c = d;
    }
  }
  const double root = std::sqrt(u);
  return (1 - root) * a + root * (1 - v) * b + root * v * c;
}

Vector3 cosine_direction(const Vector3& normal, double u, double v) {
  // Uniform on a disc, projected up to the hemisphere (Malley). 1 - u > 0 keeps the direction off the plane.
  const double radius = std::sqrt(u);
  const double angle = 2 * std::numbers::pi * v;
  const Vector3 tangent = normal.unitOrthogonal();
  const Vector3 bitangent = normal.cross(tangent);
  return (radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
          std::sqrt(1 - u) * normal)
      .normalized();
}

EmitterTable::EmitterTable(const PatchMesh& mesh) : density_(Eigen::VectorXd::Zero(mesh.patch_count())) {
  double total = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const double brightest = mesh.emission.row(i).maxCoeff();
    if (brightest <= 0) continue;
    density_[i] = brightest;
    total += mesh.area[i] * brightest;
    emitters_.push_back(i);
    cumulative_.push_back(total);
  }
  if (total > 0) density_ /= total;
}

Index EmitterTable::pick(double u) const {
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), u * cumulative_.back());
  const auto at = std::min<std::ptrdiff_t>(above - cumulative_.begin(),
                                           static_cast<std::ptrdiff_t>(emitters_.size()) - 1);
  return emitters_[static_cast<std::size_t>(at)];
}

}  // namespace radiosity
