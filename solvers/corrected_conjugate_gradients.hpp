#pragma once

#include "solvers/stepped_solver.hpp"

#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// Conjugate gradients on the symmetric form of the true kernel, preconditioned by the solution with another
/// operator, such as a compressed one: exact answers at the price of a few true products. Where light
/// survives many bounces in each of several rooms, give the other operator the right action on every room's
/// uniform light
/// ("closure=blocks", a coarse space of one vector a room).
///
/// The inner system (I - S~) z = r, S~ = R^{1/2} K~ R^{1/2}, is solved by conjugate gradients to 1e-3, so
/// that the preconditioner varies from step to step: directions are made conjugate to the last one explicitly
/// (flexible conjugate gradients, Notay 2000). Where I - S~ turns out not to be positive on a direction, the
/// inner solution stops before it. products() counts true products alone.
class CorrectedConjugateGradients final : public SteppedSolver {
 public:
  /// Throws UsageError if either operator is not a symmetric kernel, or if no other operator can be built
  /// here.
  CorrectedConjugateGradients(const SolverProblem& problem, const std::string& preconditioner);

  std::string describe() const override { return "cg:preconditioner=" + spec_; }

 private:
  enum class Next { evaluate, iterate };

  struct Column {
    Next next = Next::evaluate;
    bool started = false;
    int fruitless_evaluations = 0;
  };

  void begin() override;
  void advance() override;
  /// Takes the true residual from K b; returns whether the column goes on with a new direction.
  bool evaluate(Index j, const Eigen::VectorXd& kernel_product);
  /// One step along the direction; returns whether it goes on with a new direction.
  bool iterate(Index j, const Eigen::VectorXd& kernel_product);
  /// z = (I - S~)^{-1} r for the residuals of these columns, as far as it goes.
  Field precondition(const std::vector<Index>& columns) const;
  void renew_directions(const std::vector<Index>& columns);
  void show_radiosity(Index j);

  std::string spec_;
  std::unique_ptr<LinearOperator> approximation_;
  const KernelOperator& kernel_;
  const KernelOperator& other_;
  Field root_reflectance_;  ///< R^{1/2}, n x channels
  Field solution_;          ///< w
  Field residual_;          ///< r
  Field direction_;         ///< p
  Field image_;             ///< (I - S) p of the last step; 0: none yet
  std::vector<Column> columns_;
};

}  // namespace radiosity
