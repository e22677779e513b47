#pragma once

#include "factorizations/lapack.hpp"
#include "factorizations/matrix_products.hpp"

#include <cstdint>

namespace radiosity {

struct LanczosOptions {
  Eigen::Index rank = 0;   ///< values wanted, at most min(m, n) are there
  Eigen::Index basis = 0;  ///< vectors kept between restarts; 0: 2 rank + 20
  int restarts = 1000;     ///< before it gives up
  std::uint64_t seed = 1;
};

/// The largest singular values of A, falling, by Spectra's restarted Lanczos on [0 A; A' 0], whose
/// eigenvalues are plus and minus the singular values (never on A'A, which has lost those below 1e-8 of the
/// largest). Products only. Each ||A' u - value v|| and ||A v - value u|| is at most 1e-13 of the largest
/// value or it throws Error: singular values are right to 1e-3 down to 1e-10 of the largest. One vector's
/// Krylov space shows one copy of a multiple value: rounds in the complement of what was found add the others
/// until a random search there meets nothing larger than the smallest that is kept.
SingularValues lanczos_svd(const MatrixProducts& A, const LanczosOptions& options);

/// The eigenpairs of a symmetric A that are largest in magnitude, falling in magnitude, alike: ||A v -
/// value v|| at most 1e-13 of the largest. All of them
/// (rank >= n) come from LAPACK, from n products.
SymmetricEigenpairs lanczos_eigenpairs(const MatrixProducts& A, const LanczosOptions& options);

}  // namespace radiosity
