#include "solvers/solver.hpp"

#include "foundation/error.hpp"

namespace radiosity {

const Field& solve(Solver& solver, const Field& emission) {
  solver.start(emission);
  while (!solver.converged()) solver.step();
  return solver.radiosity();
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
