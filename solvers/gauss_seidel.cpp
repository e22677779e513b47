#include "solvers/gauss_seidel.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

constexpr int sweeps_until_judged = 100;

}  // namespace

GaussSeidel::GaussSeidel(const SolverProblem& problem) : SteppedSolver("gauss-seidel", problem) {}

void GaussSeidel::begin() {
  const SpectralRadius radius = bound_spectral_radius(transport(), std::min(20, options().max_products));
  spend_products(radius.products);
  require_contraction(name(), radius);
  if (!rows_) rows_.emplace(name(), transport(), root_area(), options().matrix_bytes);
  mutable_radiosity() = emission();
  scaled_ = root_area().asDiagonal() * emission();
  failed_checks_.assign(static_cast<std::size_t>(emission().cols()), 0);
  last_change_.assign(static_cast<std::size_t>(emission().cols()), 0);
  sweeps_ = 0;
}

void GaussSeidel::advance() {
  spend_products();
  ++sweeps_;
  std::vector<Index> promising;
  for (const Index j : open_columns()) {
    const double change = sweep(j);
    mutable_radiosity().col(j) = scaled_.col(j).cwiseQuotient(root_area());
    // After a sweep the residual is U times the change, U the part of T above the diagonal: at most about the
    // change.
    if (small_enough(j, 0.5 * change)) promising.push_back(j);
    if (sweeps_ % sweeps_until_judged == 0) refuse_if_too_slow(j, change);
    last_change_[static_cast<std::size_t>(j)] = change;
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

void GaussSeidel::refuse_if_too_slow(Index j, double change) const {
  const double rate = change / last_change_[static_cast<std::size_t>(j)];
  const double wanted = options().tolerance * emission_norm(j) / change;
  if (!(rate < 1 && wanted < 1)) return;
  const double remaining = std::log(wanted) / std::log(rate);
  const int budget = options().max_products - products();
  if (remaining > 2.0 * budget)
    fail(
        "{}: needs about {:.0f} more sweeps at its present rate and has a budget of {}: use cg or gmres, or "
        "allow more "
        "products.",
        name(), remaining, budget);
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
    if (failures >= 10) end_stagnated(j);
  }
}

}  // namespace radiosity
