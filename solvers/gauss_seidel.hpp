#pragma once

#include "solvers/materialized_transport.hpp"
#include "solvers/spectral_radius.hpp"
#include "solvers/stepped_solver.hpp"

#include <optional>

namespace radiosity {

/// Gauss-Seidel as in 003, Algorithm 1: for each patch in turn B_i <- E_i + rho_i sum_j F_ij B_j with the
/// newest B. A step is a sweep over all patches and counts as one product; the residual of B takes another,
/// made once the change of a sweep suggests that it is small enough. Reads the entries of T once, at the
/// first start(): n x n doubles. Like the Neumann series it refuses where the spectral radius is not bounded
/// below 1.
class GaussSeidel final : public SteppedSolver {
 public:
  explicit GaussSeidel(const SolverProblem& problem);

  std::string describe() const override { return "gauss-seidel"; }

 private:
  void begin() override;
  void advance() override;
  double sweep(Index j);
  void refuse_if_too_slow(Index j, double change) const;
  void check(const std::vector<Index>& columns);

  std::optional<TransportRows> rows_;
  Field scaled_;                     ///< A^{1/2} B
  std::vector<int> failed_checks_;   ///< in a row without gain, for each column
  std::vector<double> last_change_;  ///< of the sweep before, for each column
  int sweeps_ = 0;
};

}  // namespace radiosity
