#include "render/vertex_radiosity.hpp"

#include "foundation/error.hpp"

#include <algorithm>

namespace radiosity {

VertexRadiosity::VertexRadiosity(const PatchMesh& mesh, const Eigen::MatrixXd& B)
    : mesh_(mesh), corners_(mesh) {
  const Index n = mesh.patch_count();
  if (B.rows() != n && B.rows() != 4 * n)
    fail<UsageError>("radiosity at vertices needs {} rows, or {} for each corner, not {}", n, 4 * n,
                     B.rows());
  values_ = Eigen::MatrixXd::Zero(corners_.count(), B.cols());
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(corners_.count());
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k) {
      values_.row(corners_.of(i, k)) += mesh.area[i] * B.row(B.rows() == n ? i : 4 * i + k);
      weight[corners_.of(i, k)] += mesh.area[i];
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
