#pragma once

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// Which of m clusters each of n rows belongs to, from the m leading eigenvectors (n x m, orthonormal) of a
/// matrix of m weakly coupled blocks: column-pivoted QR picks a typical row of each cluster, a rotation turns
/// the vectors into indicators, and the largest entry decides (Damle, Minden and Ying, "Simple, direct and
/// efficient multi-way spectral clustering", 2019). No start values, no randomness. Clusters are numbered by
/// their first row; fewer than m may come out. m = 0 or 1 gives one cluster.
std::vector<int> spectral_clusters(const Eigen::MatrixXd& vectors);

}  // namespace radiosity
