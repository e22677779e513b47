#pragma once

#include "kernels/symmetric_tiles.hpp"

#include <Eigen/Core>

#include <string>

namespace radiosity {

/// What closing a kernel came to.
struct ClosureResult {
  std::string kind;  ///< "symmetric" or "energy-removing"
  std::string note;  ///< why symmetric scaling was not used; empty otherwise
  int sweeps = 0;
};

/// Assembly closure: scales K to D K D, D diagonal, so that sum_j F_ij = target_i. Sampling errors then no
/// longer add or lose energy. Exact scaling does not always exist (empty rows, bipartite visibility): unless
/// it reaches 1e-8 within 200 sweeps with every d in [1/2, 2], d = min(1, target / row sum) is used, which
/// always exists and only removes energy. Rows with target 0 (patches that are not live) are left alone.
/// `area` and `target`: n.
ClosureResult close_symmetric(SymmetricTiles<double>& kernel, const Eigen::VectorXd& area,
                              const Eigen::VectorXd& target);

}  // namespace radiosity
