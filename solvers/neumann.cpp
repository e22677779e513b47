#include "solvers/neumann.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

NeumannForecast forecast_neumann(const LinearOperator& transport, const SolverOptions& options) {
  const SpectralRadius radius = bound_spectral_radius(transport, std::min(20, options.max_products));
  const double bound = require_contraction("neumann", radius);
  const double predicted = bound == 0 ? 1 : std::ceil(std::log(options.tolerance) / std::log(bound));
  const int left = options.max_products - radius.products;
  if (predicted > left)
    fail(
        "neumann: needs about {:.0f} products at a spectral radius of up to {:.12g} and has a budget of {}: "
        "use cg or "
        "gmres, or allow more products.",
        predicted, bound, left);
  return {bound, std::max(1, static_cast<int>(predicted)), radius.products};
}

Neumann::Neumann(const SolverProblem& problem) : SteppedSolver("neumann", problem) {}

void Neumann::begin() {
  mutable_radiosity() = emission();
  steps_ = 0;
  const NeumannForecast forecast = forecast_neumann(transport(), options());
  spend_products(forecast.products);
  predicted_steps_ = forecast.steps;
}

void Neumann::advance() {
  spend_products();
  ++steps_;
  const Field gathered = multiply_open(radiosity());
  const std::vector<Index> columns = open_columns();
  // The bound holds in a weighted maximum norm; twice its count leaves room for the change to the area norm.
  const bool overdue = steps_ > 2 * predicted_steps_ + 50;
  for (const Index j : columns) {
    const Eigen::VectorXd next = emission().col(j) + gathered.col(j);
    const double residual_norm = root_area().cwiseProduct(next - radiosity().col(j)).norm();
    accept_residual(j, residual_norm);
    if (small_enough(j, residual_norm)) continue;
    if (overdue) {
      end_stagnated(j);
      continue;
    }
    mutable_radiosity().col(j) = next;
  }
}

}  // namespace radiosity
