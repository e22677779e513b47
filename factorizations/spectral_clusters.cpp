#include "factorizations/spectral_clusters.hpp"

#include "factorizations/lapack.hpp"

#include <algorithm>
#include <cstddef>

namespace radiosity {

namespace {

/// Numbers clusters 0, 1, ... in the order in which rows meet them.
void number_by_first_row(std::vector<int>& clusters) {
  std::vector<int> number(clusters.size(), -1);
  int used = 0;
  for (int& cluster : clusters) {
    int& renamed = number[static_cast<std::size_t>(cluster)];
    if (renamed < 0) renamed = used++;
    cluster = renamed;
  }
}

}  // namespace

std::vector<int> spectral_clusters(const Eigen::MatrixXd& vectors) {
  const Eigen::Index m = vectors.cols();
  std::vector<int> clusters(static_cast<std::size_t>(vectors.rows()), 0);
  if (m < 2 || vectors.rows() < m) return clusters;
  const PivotedQr qr = pivoted_qr(vectors.transpose());
  Eigen::MatrixXd typical(m, m);
  for (Eigen::Index c = 0; c < m; ++c) typical.col(c) = vectors.row(qr.pivots[static_cast<std::size_t>(c)]);
  const SingularValues svd = singular_value_decomposition(typical);
  const Eigen::MatrixXd indicators = vectors * (svd.U * svd.V.transpose());
  for (Eigen::Index i = 0; i < vectors.rows(); ++i) {
    Eigen::Index largest = 0;
    indicators.row(i).cwiseAbs().maxCoeff(&largest);
    clusters[static_cast<std::size_t>(i)] = static_cast<int>(largest);
  }
  number_by_first_row(clusters);
  return clusters;
}

}  // namespace radiosity
