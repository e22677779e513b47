#include "operators/patch_coordinates.hpp"

namespace radiosity {

Eigen::MatrixXd patch_coordinates(const PatchMesh& mesh) {
  const Index n = mesh.patch_count();
  if (mesh.centroid.cols() != n || mesh.normal.cols() != n)
    return Eigen::RowVectorXd::LinSpaced(n, 0, static_cast<double>(n));
  Eigen::MatrixXd coordinates(6, n);
  coordinates.topRows(3) = mesh.centroid;
  const Eigen::VectorXd extent = mesh.centroid.rowwise().maxCoeff() - mesh.centroid.rowwise().minCoeff();
  coordinates.bottomRows(3) = 0.5 * extent.maxCoeff() * mesh.normal;
  return coordinates;
}

}  // namespace radiosity
