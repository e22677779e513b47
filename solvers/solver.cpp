#include "solvers/solver.hpp"

#include "foundation/error.hpp"

#include <cmath>

namespace radiosity {

const Field& solve(Solver& solver, const Field& emission) {
  solver.start(emission);
  while (!solver.converged()) solver.step();
  return solver.radiosity();
}

void check_emission(const std::string& name, const LinearOperator& transport, const Field& emission) {
  if (emission.rows() != transport.size())
    fail<UsageError>("{}: the emission has {} rows where the operator has {} patches.", name, emission.rows(),
                     transport.size());
  if (emission.cols() % transport.channels() != 0)
    fail<UsageError>("{}: the emission has {} columns, which is no multiple of the {} channels.", name,
                     emission.cols(), transport.channels());
  for (Index j = 0; j < emission.cols(); ++j)
    for (Index i = 0; i < emission.rows(); ++i)
      if (!std::isfinite(emission(i, j)))
        fail<UsageError>("{}: the emission of patch {}, column {} is {}: emissions must be finite.", name, i,
                         j, emission(i, j));
}

void require_transport(const std::string& name, const LinearOperator& transport) {
  if (transport.global())
    fail<UsageError>("{} solves B = E + T B, and {} maps E to B itself: leave the solver away.", name,
                     transport.describe());
}

Eigen::RowVectorXd area_norms(const Eigen::VectorXd& root_area, const ConstFieldRef& X) {
  if (root_area.size() != X.rows())
    fail<UsageError>("A field of {} rows was measured with {} areas: both need one row per patch.", X.rows(),
                     root_area.size());
  Eigen::RowVectorXd norms(X.cols());
  for (Index j = 0; j < X.cols(); ++j) norms[j] = root_area.cwiseProduct(X.col(j)).norm();
  return norms;
}

}  // namespace radiosity
