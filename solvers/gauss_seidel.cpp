#include "solvers/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

GaussSeidel::GaussSeidel(const SolverProblem& problem) : SteppedSolver("gauss-seidel", problem) {}

void GaussSeidel::begin() {
  const SpectralRadius radius = bound_spectral_radius(transport(), std::min(20, options().max_products));
  spend_products(radius.products);
  require_contraction(name(), radius);
  if (!rows_) rows_.emplace(name(), transport(), root_area(), options().matrix_bytes);
  mutable_radiosity() = emission();
  scaled_ = root_area().asDiagonal() * emission();
  failed_checks_.assign(static_cast<std::size_t>(emission().cols()), 0);
}

void GaussSeidel::advance() {
  spend_products();
  std::vector<Index> promising;
  for (const Index j : open_columns()) {
    const double change = sweep(j);
    mutable_radiosity().col(j) = scaled_.col(j).cwiseQuotient(root_area());
    // After a sweep the residual is U times the change, U the part of T above the diagonal: at most about the
    // change.
    if (small_enough(j, 0.5 * change)) promising.push_back(j);
  }
  if (!promising.empty()) check(promising);
}

double GaussSeidel::sweep(Index j) {
  Eigen::VectorXd field = scaled_.col(j);
  double squared_change = 0;
  for (Index i = 0; i < size(); ++i) {
    const double gathered = root_area()[i] * emission()(i, j) + rows_->gather(i, j % channels(), field);
    squared_change += (gathered - field[i]) * (gathered - field[i]);
    field[i] = gathered;
  }
  scaled_.col(j) = field;
  return std::sqrt(squared_change);
}

void GaussSeidel::check(const std::vector<Index>& columns) {
  spend_products();
  const Field gathered = multiply_open(radiosity());
  for (const Index j : columns) {
    const double before = accepted_residual(j);
    const double norm =
        root_area().cwiseProduct(emission().col(j) - radiosity().col(j) + gathered.col(j)).norm();
    accept_residual(j, norm);
    int& failures = failed_checks_[static_cast<std::size_t>(j)];
    failures = accepted_residual(j) < before ? 0 : failures + 1;
    if (failures >= 10) fail_as_stagnated(j);
  }
}

}  // namespace radiosity
