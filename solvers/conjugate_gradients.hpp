#pragma once

#include "solvers/stepped_solver.hpp"

namespace radiosity {

/// Conjugate gradients on the symmetric form (methods.md, "Solvers"). With S = R^{1/2} K R^{1/2}, e = A^{1/2}
/// E and b = A^{1/2} B it solves (I - S) w = R^{1/2} K e and takes b = e + R^{1/2} w, so that nothing is
/// divided by a reflectance and black patches are welcome. Needs a symmetric kernel with max_i rho_i sum_j
/// F_ij < 1.
///
/// All columns go in lockstep, one product with K a step. A column either takes a step of conjugate gradients
/// or has its residual computed afresh: at the start, when the recurred residual says that it has converged,
/// and when that residual has not improved for long. The area norm of B's residual is ||R^{1/2} r||, r the
/// residual of w.
class ConjugateGradients final : public SteppedSolver {
 public:
  /// Throws UsageError if the operator is not a symmetric kernel.
  explicit ConjugateGradients(const SolverProblem& problem);

  std::string describe() const override { return "cg"; }

 private:
  enum class Next { evaluate, iterate };

  struct Column {
    Next next = Next::evaluate;
    double squared_residual = 0;   ///< r' r
    double smallest_residual = 0;  ///< of ||R^{1/2} r|| since the last evaluation
    int steps_without_progress = 0;
    int fruitless_evaluations = 0;
    bool evaluated = false;
  };

  void begin() override;
  void advance() override;
  void evaluate(Index j, const Eigen::VectorXd& kernel_product);
  void iterate(Index j, const Eigen::VectorXd& kernel_product);
  void show_radiosity(Index j);

  const KernelOperator& kernel_;
  Field root_reflectance_;  ///< R^{1/2}, n x channels
  Field solution_;          ///< w
  Field residual_;          ///< r
  Field direction_;         ///< p
  std::vector<Column> columns_;
};

}  // namespace radiosity
