#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>

namespace radiosity {

/// y = K x for a symmetric n x n matrix K.
using VectorProduct = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Diagonal factors that give D K D wanted row sums, and whether they do.
struct SymmetricScaling {
  Eigen::VectorXd factors;  ///< d, n
  bool exists = false;      ///< false: `factors` only scale down
  std::string note;         ///< why there is no such scaling; empty otherwise
  int sweeps = 0;           ///< products spent
};

/// Looks for d > 0 with d_i (K (d . w))_i = target_i w_i by symmetric Sinkhorn sweeps. With w = A^{1/2} these
/// are the row sums of F. Such a scaling does not always exist (empty rows, bipartite visibility, negative
/// entries): unless row sums come within `tolerance` (what rounding in K's products allows) in 200 sweeps
/// with every d in [1/2, 2], d = min(1, target / row sum) is returned, which exists for every non-negative K
/// and only removes energy. Rows with target 0 keep d = 1. (methods.md, "Layers": closure by scaling.)
SymmetricScaling scale_symmetric(const VectorProduct& K, const Eigen::VectorXd& weights,
                                 const Eigen::VectorXd& target, double tolerance = 1e-8);

}  // namespace radiosity
