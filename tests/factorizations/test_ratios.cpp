#include "test_ratios.hpp"

#include <algorithm>

namespace radiosity::testing {

using Eigen::MatrixXd;

double orthogonality(const MatrixXd& Q) {
  if (Q.size() == 0) return 0;
  return (MatrixXd::Identity(Q.cols(), Q.cols()) - Q.transpose() * Q).cwiseAbs().maxCoeff() /
         (static_cast<double>(Q.rows()) * double_roundoff);
}

double residual(const MatrixXd& A, const SingularValues& svd) {
  const double largest = A.cwiseAbs().maxCoeff();
  if (largest == 0) return svd.values.size() == 0 ? 0 : svd.values.maxCoeff() / double_roundoff;
  const MatrixXd difference = A / largest - svd.U * (svd.values / largest).asDiagonal() * svd.V.transpose();
  return difference.norm() /
         ((A / largest).norm() * static_cast<double>(std::max(A.rows(), A.cols())) * double_roundoff);
}

double triplet_residual(const MatrixXd& A, const SingularValues& svd) {
  const double largest = A.cwiseAbs().maxCoeff();
  if (largest == 0) return svd.values.size() == 0 ? 0 : svd.values.maxCoeff() / double_roundoff;
  const MatrixXd scaled = A / largest;
  const auto S = (svd.values / largest).asDiagonal();
  return std::max((scaled * svd.V - svd.U * S).norm(), (scaled.transpose() * svd.U - svd.V * S).norm()) /
         (scaled.norm() * static_cast<double>(std::max(A.rows(), A.cols())) * double_roundoff);
}

}  // namespace radiosity::testing
