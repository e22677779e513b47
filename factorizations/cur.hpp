#pragma once

#include "factorizations/basis_projection.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

/// What stands between the columns C and the rows R of A.
enum class CurCore {
  projection,    ///< C^+ A R^+: the best there is for these rows and columns; reads all of A
  interpolation  ///< the inverse of the intersection: reads nothing of A but C and R
};

struct CurOptions {
  Eigen::Index rank = 0;  ///< rows and columns wanted
  CurCore core = CurCore::projection;
  std::uint64_t seed = 1;
};

struct CurDecomposition {
  std::vector<Eigen::Index> columns;
  std::vector<Eigen::Index> rows;
  LowRankPair factors;
};

/// A ~ C M R from some columns C and rows R of A (Goreinov, Tyrtyshnikov and Zamarashkin 1997). Columns are
/// those of leading_columns; rows are those that QR with column pivoting picks of Q', Q an orthonormal basis
/// of C (Drmac and Gugercin 2016, Q-DEIM), so that ||Q(rows)^{-1}|| stays small. Neither core inverts an
/// ill-conditioned matrix: the projection is Q (Q' A W) W', W an orthonormal basis of R'; the interpolation
/// C A(rows, columns)^{-1} R is computed as Q Q(rows)^{-1} R. Fewer rows and columns where the rank of A is
/// lower.
CurDecomposition cur_decomposition(const MatrixProducts& A, const CurOptions& options);

}  // namespace radiosity
