#include "solvers/lu.hpp"

#include "foundation/error.hpp"
#include "solvers/materialized_transport.hpp"

#include <utility>

namespace radiosity {

Lu::Lu(const SolverProblem& problem) : SteppedSolver("lu", problem) {}

void Lu::begin() {
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport());
  const Eigen::MatrixXd reflectance = kernel != nullptr ? kernel->reflectance() : Eigen::MatrixXd();
  if (factors_.empty() || reflectance_ != reflectance) {
    require_memory(name(), size(), channels(), options().matrix_bytes);
    std::vector<Eigen::MatrixXd> matrices = transport_matrices(transport());
    factors_.clear();
    for (Eigen::MatrixXd& matrix : matrices) {
      matrix = -(root_area().asDiagonal() * matrix * root_area().cwiseInverse().asDiagonal());
      matrix.diagonal().array() += 1;
      factors_.emplace_back(std::move(matrix));
      if (factors_.back().reciprocal_condition() >= static_cast<double>(size()) * double_roundoff) continue;
      factors_.clear();
      fail_as_singular();
    }
    reflectance_ = reflectance;
  }
  residuals_ = root_area().asDiagonal() * emission();
  steps_ = 0;
}

void Lu::advance() {
  if (steps_ > 0) spend_products();
  for (const Index j : open_columns())
    mutable_radiosity().col(j) += factors_[static_cast<std::size_t>(j % channels())]
                                      .solve(residuals_.col(j))
                                      .col(0)
                                      .cwiseQuotient(root_area());

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
