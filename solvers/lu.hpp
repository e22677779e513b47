#pragma once

#include "factorizations/lapack.hpp"
#include "solvers/stepped_solver.hpp"

#include <vector>

namespace radiosity {

/// The direct answer from the entries of I - T, channel by channel, by LU with partial pivoting (LAPACK) in
/// scaled coordinates A^{1/2} B. One step answers and computes the residual with the operator's own product;
/// where that misses the tolerance, further steps are iterative refinements. products() counts the
/// refinements, not the product that checks the direct answer. Reads the entries and factors them at the
/// first start(), n x n doubles a channel, and again when a kernel's reflectance has changed. Refuses as
/// singular where the estimated reciprocal condition number is below n u.
class Lu final : public SteppedSolver {
 public:
  explicit Lu(const SolverProblem& problem);

  std::string describe() const override { return "lu"; }

 private:
  void begin() override;
  void advance() override;

  std::vector<LuFactors> factors_;  ///< of I - A^{1/2} T A^{-1/2}, one a channel
  Eigen::MatrixXd reflectance_;     ///< what the factors were made for; empty for operators without a kernel
  Field residuals_;                 ///< A^{1/2} (E - (I - T) B)
  int steps_ = 0;
};

}  // namespace radiosity
