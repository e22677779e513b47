#pragma once

#include "operators/capacitance.hpp"
#include "solvers/stepped_solver.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The direct answer with an operator of low rank, T = R U V' (document 004, Woodbury's formula):
///
///   B = E + R U (I - V' R U)^-1 V' E,
///
/// two products of n x k and one of k x k a column. The capacitance matrix I - V' R U of each channel is made
/// and factored in double at the first start() (LowRankFactors::multiply_between), and again when the
/// reflectance has changed. One step answers and computes the residual with the operator's own product; where
/// that misses the tolerance, further steps are iterative refinements with the same factors. products()
/// counts the refinements. Refuses as singular where a capacitance matrix is not to be told from a singular
/// one (CapacitanceMatrices::singular).
class Woodbury final : public SteppedSolver {
 public:
  /// Throws UsageError if the operator is not of low rank.
  explicit Woodbury(const SolverProblem& problem);

  std::string describe() const override { return "woodbury"; }

 private:
  void begin() override;
  void advance() override;
  Field coefficients(const ConstFieldRef& fields, const std::vector<Index>& columns) const;
  /// B = (I - T)^-1 E.
  void answer();
  /// B += (I - T)^-1 times the residual, for the columns.
  void refine(const std::vector<Index>& columns);

  const LowRankFactors& factors_;
  std::optional<CapacitanceMatrices> capacitances_;
  std::uint64_t reflectance_ = 0;  ///< fingerprint of those that they were made for
  Field residuals_;                ///< E - (I - T) B; empty before the first step and after the last
  int steps_ = 0;
};

}  // namespace radiosity
