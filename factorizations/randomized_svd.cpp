#include "factorizations/randomized_svd.hpp"

#include "foundation/error.hpp"

#include <algorithm>

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// An orthonormal basis as wide as X or as high; where X lacks rank it is filled up, which does no harm.
MatrixXd basis_of(const MatrixXd& X) {
  return pivoted_qr(X).Q;
}

}  // namespace

SingularValues randomized_svd(const MatrixProducts& products, const RandomizedSvdOptions& options) {
  if (options.rank < 0 || options.oversampling < 0 || options.power_steps < 0)
    fail<UsageError>(
        "a randomized SVD of rank {} with {} more columns and {} power steps: none may be negative",
        options.rank, options.oversampling, options.power_steps);
  const Index smaller = std::min(products.rows, products.columns);
  const Index rank = std::min(options.rank, smaller);
  const Index width = std::min(rank + options.oversampling, smaller);
  if (rank == 0) return {MatrixXd(products.rows, 0), Eigen::VectorXd(0), MatrixXd(products.columns, 0)};
  MatrixXd Q = basis_of(products.apply(normal_numbers(products.columns, width, options.seed)));
  for (int step = 0; step < options.power_steps; ++step)
    Q = basis_of(products.apply(basis_of(products.apply_transposed(Q))));
  // A ~ Q (Q' A) = Q (W S Z')'  with  A' Q = W S Z'.
  const SingularValues small = singular_value_decomposition(products.apply_transposed(Q));
  return {Q * small.V.leftCols(rank), small.values.head(rank), small.U.leftCols(rank)};
}

}  // namespace radiosity
