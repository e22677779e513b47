#include "solvers/lu.hpp"

#include "foundation/error.hpp"
#include "solvers/materialized_transport.hpp"

#include <lapacke.h>

#include <utility>

namespace radiosity {

Lu::Lu(const SolverProblem& problem) : SteppedSolver("lu", problem) {}

void Lu::begin() {
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport());
  const Eigen::MatrixXd reflectance = kernel != nullptr ? kernel->reflectance() : Eigen::MatrixXd();
  if (factors_.empty() || reflectance_ != reflectance) {
    require_memory(name(), size(), channels(), options().matrix_bytes);
    std::vector<Eigen::MatrixXd> matrices = transport_matrices(transport());
    factors_.assign(matrices.size(), Factors{});
    for (std::size_t c = 0; c < matrices.size(); ++c) {
      Eigen::MatrixXd& system = factors_[c].triangles;
      system = -(root_area().asDiagonal() * matrices[c] * root_area().cwiseInverse().asDiagonal());
      matrices[c].resize(0, 0);
      system.diagonal().array() += 1;
      factor(factors_[c], system.cwiseAbs().colwise().sum().maxCoeff());
    }
    reflectance_ = reflectance;
  }
  residuals_ = root_area().asDiagonal() * emission();
  steps_ = 0;
}

void Lu::factor(Factors& factors, double norm) {
  const auto n = static_cast<lapack_int>(size());
  factors.pivots.resize(static_cast<std::size_t>(n));
  const lapack_int zero_pivot =
      LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, factors.triangles.data(), n, factors.pivots.data());
  double reciprocal_condition = 0;
  if (zero_pivot == 0)
    LAPACKE_dgecon(LAPACK_COL_MAJOR, '1', n, factors.triangles.data(), n, norm, &reciprocal_condition);
  if (!(reciprocal_condition >= static_cast<double>(n) * unit_roundoff)) {
    factors_.clear();
    fail_as_singular();
  }
}

void Lu::advance() {
  if (steps_ > 0) spend_products();
  const auto n = static_cast<lapack_int>(size());
  for (const Index j : open_columns()) {
    const Factors& factors = factors_[static_cast<std::size_t>(j % channels())];
    Eigen::VectorXd correction = residuals_.col(j);
    LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', n, 1, factors.triangles.data(), n, factors.pivots.data(),
                   correction.data(), n);
    mutable_radiosity().col(j) += correction.cwiseQuotient(root_area());
  }

  const Field gathered = multiply_open(radiosity());
  const std::vector<Index> columns = open_columns();
  for (const Index j : columns) {
    residuals_.col(j) = root_area().cwiseProduct(emission().col(j) - radiosity().col(j) + gathered.col(j));
    const double before = accepted_residual(j);
    const double norm = residuals_.col(j).norm();
    accept_residual(j, norm);
    if (!small_enough(j, norm) && steps_ > 0 && accepted_residual(j) > 0.5 * before) end_stagnated(j);
  }
  ++steps_;
}

}  // namespace radiosity
