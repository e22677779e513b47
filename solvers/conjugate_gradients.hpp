#pragma once

#include "solvers/compressed_solution.hpp"
#include "solvers/stepped_solver.hpp"

#include <optional>
#include <string>
#include <vector>

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
///
/// A preconditioner, the solution with another operator, gives exact answers at the price of a few products
/// with the true one. Where light survives many bounces in each of several rooms, it has to be right on every
/// room's uniform light ("closure=blocks", a coarse space of one vector a room). As it varies from step to
/// step, each direction is made conjugate to the one before explicitly (flexible conjugate gradients, Notay
/// 2000). products() counts the true ones.
class ConjugateGradients final : public SteppedSolver {
 public:
  /// `preconditioner` is an operator's spec, or empty. Throws UsageError if either operator is not a
  /// symmetric kernel.
  explicit ConjugateGradients(const SolverProblem& problem, const std::string& preconditioner = {});

  std::string describe() const override;

 private:
  enum class Next { evaluate, iterate };

  struct Column {
    Next next = Next::evaluate;
    double curvature = 0;          ///< p' (I - S) p of the last step; 0: none since the last evaluation
    double smallest_residual = 0;  ///< of ||R^{1/2} r|| since the last evaluation
    int steps_without_progress = 0;
    int fruitless_evaluations = 0;
    bool evaluated = false;
  };

  void begin() override;
  void advance() override;
  /// Takes the residual of B afresh from K b.
  void evaluate(Index j, const Eigen::VectorXd& kernel_product);
  /// One step along the direction.
  void iterate(Index j, const Eigen::VectorXd& kernel_product);
  void renew_directions(const std::vector<Index>& columns);
  void show_radiosity(Index j);

  const KernelOperator& kernel_;
  std::optional<CompressedSolution> preconditioner_;
  Field root_reflectance_;  ///< R^{1/2}, n x channels
  Field solution_;          ///< w
  Field residual_;          ///< r
  Field direction_;         ///< p
  Field image_;             ///< (I - S) p
  std::vector<Column> columns_;
};

}  // namespace radiosity
