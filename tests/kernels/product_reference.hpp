#pragma once

#include "foundation/random.hpp"
#include "kernels/stored_number.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace radiosity {

/// Sizes around every boundary of the kernels: vectors, groups of rows, tiles, runs of four tiles.
inline std::vector<Index> hard_sizes() {
  return {0, 1, 2, 3, 5, 17, 33, 63, 64, 65, 127, 200, 257};
}

inline Eigen::MatrixXd random_matrix(Index rows, Index cols, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::MatrixXd matrix(rows, cols);
  // Of both signs and over six decades, so that cancellation and small entries take part.
  for (Index j = 0; j < cols; ++j)
    for (Index i = 0; i < rows; ++i)
      matrix(i, j) = random.uniform(-1, 1) * std::pow(10.0, -static_cast<double>(random.below(7)));
  return matrix;
}

inline Eigen::MatrixXd random_symmetric_matrix(Index n, std::uint64_t seed) {
  const Eigen::MatrixXd matrix = random_matrix(n, n, seed);
  return matrix.selfadjointView<Eigen::Upper>();
}

/// The tiles of a symmetric matrix, only those for which `kept(I, J)` holds.
template <typename Kept>
SymmetricTiles<double> tiles_of(const Eigen::MatrixXd& matrix, const Kept& kept) {
  SymmetricTiles<double> tiles(matrix.rows(), kept);
  for (Index j = 0; j < matrix.rows(); ++j)
    for (Index i = 0; i <= j; ++i)
      if (kept(i / 64, j / 64)) tiles.set(i, j, matrix(i, j));
  return tiles;
}

inline SymmetricTiles<double> tiles_of(const Eigen::MatrixXd& matrix) {
  return tiles_of(matrix, [](Index, Index) { return true; });
}

/// |Y - M X| <= 2 n u |M| |X|, component by component, with the product in long double.
inline testing::AssertionResult within_product_bound(const Eigen::MatrixXd& M, const Eigen::MatrixXd& X,
                                                     const Eigen::MatrixXd& Y, double unit_roundoff) {
  for (Index j = 0; j < X.cols(); ++j)
    for (Index i = 0; i < M.rows(); ++i) {
      long double exact = 0;
      long double magnitude = 0;
      for (Index k = 0; k < M.cols(); ++k) {
        const long double term = static_cast<long double>(M(i, k)) * X(k, j);
        exact += term;
        magnitude += std::fabs(term);
      }
      const long double bound = 2.0L * static_cast<long double>(M.cols()) * unit_roundoff * magnitude;
      if (!(std::fabs(Y(i, j) - exact) <= bound))
        return testing::AssertionFailure()
               << "entry (" << i << ", " << j << ") is " << Y(i, j) << ", should be "
               << static_cast<double>(exact) << " within " << static_cast<double>(bound);
    }
  return testing::AssertionSuccess();
}

using StorageTypes = testing::Types<double, float, Half>;

}  // namespace radiosity
