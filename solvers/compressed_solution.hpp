#pragma once

#include "operators/kernel_operator.hpp"
#include "solvers/solver_registry.hpp"

#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// z = (I - S~)^{-1} r with S~ = R^{1/2} K~ R^{1/2} of another operator, such as a compressed one: a
/// preconditioner for the true system. Solved by conjugate gradients to 1e-3; where I - S~ turns out not to
/// be positive, the solution stops before that direction.
class CompressedSolution {
 public:
  /// Throws UsageError if `spec` gives no symmetric kernel or no other operator can be built here.
  CompressedSolution(const SolverProblem& problem, const std::string& spec);

  const std::string& spec() const { return spec_; }

  /// Columns of residuals (n x k), column c of which belongs to the square roots of reflectances in column
  /// `channel[c]` of `root_reflectance` (n x channels).
  Field operator()(const Field& residuals, const std::vector<Index>& channel,
                   const Field& root_reflectance) const;

 private:
  std::string spec_;
  std::unique_ptr<LinearOperator> transport_;
  const KernelOperator* kernel_;
};

}  // namespace radiosity
