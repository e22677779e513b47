#include "render/vertex_radiosity.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace radiosity {
namespace {

/// Patches whose normals differ by less than this (about 0.06 degrees) lie in one plane if they share a
/// corner.
constexpr double one_plane = 1e-3;

/// What patches must share to be averaged at a corner; the normal is compared apart, as it is not exact.
using CornerKey = std::tuple<double, double, double, int, int>;

struct Slot {
  Vector3 normal;
  Index row;
};

}  // namespace

VertexRadiosity::VertexRadiosity(const PatchMesh& mesh, const Eigen::MatrixXd& B)
    : mesh_(mesh), slots_(mesh.patches.size()) {
  const Index n = mesh.patch_count();
  if (B.rows() != n && B.rows() != 4 * n)
    fail<UsageError>("radiosity at vertices needs {} rows, or {} for each corner, not {}", n, 4 * n,
                     B.rows());
  std::map<CornerKey, std::vector<Slot>> corners;
  Index rows = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
    const Vector3 normal = mesh.normal.col(i);
    for (int k = 0; k < patch.corner_count; ++k) {
      const Vector3& p = mesh.corner(i, k);
      std::vector<Slot>& here = corners[{p.x(), p.y(), p.z(), patch.group, patch.material}];
      auto found = std::find_if(here.begin(), here.end(),
                                [&](const Slot& slot) { return (slot.normal - normal).norm() < one_plane; });
      if (found == here.end()) found = here.insert(here.end(), {normal, rows++});
      slots_[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = found->row;
    }
  }

  values_ = Eigen::MatrixXd::Zero(rows, B.cols());
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows);
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k) {
      values_.row(slot(i, k)) += mesh.area[i] * B.row(B.rows() == n ? i : 4 * i + k);
      weight[slot(i, k)] += mesh.area[i];
    }
  values_.array().colwise() /= weight.array();
}

Eigen::RowVectorXd VertexRadiosity::at(Index patch, const Vector3& point) const {
  const int count = mesh_.patches[static_cast<std::size_t>(patch)].corner_count;
  const Vector3 normal = mesh_.normal.col(patch);
  const auto corner_at = [&](int k) { return mesh_.corner(patch, k % count); };
  const auto twice_area = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b - a).cross(c - a).dot(normal);
  };
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(values_.cols());
  double total = 0;
  for (int k = 0; k < count; ++k) {
    // Wachspress: the area at the corner times the distances to all edges that do not touch it.
    double weight = twice_area(corner_at(k + count - 1), corner_at(k), corner_at(k + 1));
    for (int edge = k + 1; edge < k + count - 1; ++edge)
      weight *= std::max(0.0, twice_area(point, corner_at(edge), corner_at(edge + 1)));
    sum += weight * corner(patch, k);
    total += weight;
  }
  return total > 0 ? Eigen::RowVectorXd(sum / total) : corner(patch, 0);
}

}  // namespace radiosity
