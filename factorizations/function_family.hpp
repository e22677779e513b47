#pragma once

#include "factorizations/basis_projection.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace radiosity {

/// Functions of unit length on n items, the columns of a matrix W of n x count that is known by what it does.
struct FunctionFamily {
  Eigen::Index items = 0;
  Eigen::Index count = 0;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> coefficients;       ///< W' X, count x c, X of n x c
  std::function<Eigen::MatrixXd(const std::vector<Eigen::Index>&)> columns;  ///< some of W, n x |which|
};

/// A ~ U V' where V spans the `rank` functions of the family that carry most of A, those with the largest
/// ||A w||, and U = A V. For an orthonormal family no other choice of that many of its functions is better in
/// the Frobenius norm. The lengths are estimated from 4 rank + 64 products with A', which is exact where A
/// has no more rows. Fewer columns where the rest carry nothing or depend on others (1e-10).
LowRankPair project_on_functions(const MatrixProducts& A, const FunctionFamily& family, Eigen::Index rank,
                                 std::uint64_t seed);

}  // namespace radiosity
