#pragma once

#include "solvers/spectral_radius.hpp"
#include "solvers/stepped_solver.hpp"

namespace radiosity {

/// How the Neumann series is going to converge.
struct NeumannForecast {
  double bound = 0;  ///< of the spectral radius, below 1
  int steps = 1;     ///< after which it promises ||T^k E|| <= tolerance ||E||: ln(tolerance) / ln(bound)
  int products = 0;  ///< spent on the bound
};

/// Throws Error where the radius is not known to be below 1, or where the bound predicts more products than
/// the budget allows.
NeumannForecast forecast_neumann(const LinearOperator& transport, const SolverOptions& options);

/// The Neumann series B_{k+1} = E + T B_k from B_0 = E, one bounce a step. T^{k+1} E = B_{k+1} - B_k is the
/// residual of B_k: a column ends with the B_k whose residual has been seen, not with the update to it.
/// start() bounds the spectral radius first and refuses where it is not below 1, or where the bound predicts
/// more products than the budget allows.
class Neumann final : public SteppedSolver {
 public:
  explicit Neumann(const SolverProblem& problem);

  std::string describe() const override { return "neumann"; }

  /// NeumannForecast::steps; known after start().
  int predicted_steps() const { return predicted_steps_; }

 private:
  void begin() override;
  void advance() override;

  int predicted_steps_ = 0;
  int steps_ = 0;
};

}  // namespace radiosity
