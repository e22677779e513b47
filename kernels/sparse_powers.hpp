#pragma once

#include "kernels/csr_matrix.hpp"

#include <Eigen/Core>

#include <cstddef>

namespace radiosity {

struct SparsePowersOptions {
  double threshold = 0;  ///< entries of each power, weighed, that are smaller in magnitude are dropped
  int most_powers = 1000;
  std::size_t most_bytes = std::size_t{4} << 30;  ///< of the sum
};

/// M + M^2 + M^3 + ... of an n x n matrix with small entries dropped from each power before it is multiplied
/// on and added (document 004, Section 2.2).
struct SparsePowers {
  CsrMatrix<float> sum;  ///< columns rising
  int powers = 0;        ///< taken, by the row that needed most
  /// What the powers that were not taken would add, estimated from the last two: the largest of any row in
  /// the 2-norm, relative to the row of the sum. At most 2^-24, the rounding of the sum, unless most_powers
  /// ended it.
  double remainder = 0;
};

/// Entry (i, j) weighs w_i |M_ij| / w_j, w = `weights` > 0, so that with w = A^{1/2} what is dropped from T
/// is measured in the area norm; norms are of weighed rows. Row i of a power needs row i of the one before
/// and all of M: rows are done one by one, and beside the sum only M without its small entries is kept.
/// Throws Error where the sum would take more than most_bytes, and where the powers grow without end.
SparsePowers sum_sparse_powers(const CsrMatrix<double>& M, const Eigen::VectorXd& weights,
                               const SparsePowersOptions& options);

}  // namespace radiosity
