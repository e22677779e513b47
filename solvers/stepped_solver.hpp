#pragma once

#include "solvers/solver.hpp"
#include "solvers/solver_registry.hpp"

#include <limits>
#include <string>
#include <vector>

namespace radiosity {

/// What every solver of this library shares: it checks the right-hand side, keeps E, B and the residual of
/// each column, counts products against the budget, and recognizes a singular system by the size of its
/// answer. A solver overrides begin() and advance(), and calls accept_residual() with residuals that it has
/// computed.
class SteppedSolver : public Solver {
 public:
  void start(const Field& emission) final;
  void step() final;
  bool converged() const final { return open_.empty(); }
  const Field& radiosity() const override { return radiosity_; }
  double residual() const final;
  int products() const final { return products_; }

 protected:
  /// Throws UsageError for root areas or options that make no sense. `name` opens every message.
  SteppedSolver(std::string name, const SolverProblem& problem);

  /// Called by start() unless every column is zero: radiosity() is 0, open_columns() are the columns that are
  /// not zero.
  virtual void begin() = 0;

  /// Called by step() while columns are open.
  virtual void advance() = 0;

  const std::string& name() const { return name_; }
  const LinearOperator& transport() const { return problem_.transport; }
  const Eigen::VectorXd& root_area() const { return problem_.root_area; }
  const SolverOptions& options() const { return problem_.options; }
  Index size() const { return problem_.root_area.size(); }
  Index channels() const { return problem_.transport.channels(); }

  const Field& emission() const { return emission_; }
  Field& mutable_radiosity() { return radiosity_; }

  /// ||E_j||_A, > 0 for an open column.
  double emission_norm(Index column) const { return emission_norms_[column]; }

  /// Whether a residual of this norm ends the iteration of the column.
  bool small_enough(Index column, double residual_norm) const {
    return residual_norm <= problem_.options.tolerance * emission_norms_[column];
  }

  /// The columns that have not converged, rising.
  const std::vector<Index>& open_columns() const { return open_; }

  /// T X for X of n x c. Only lights (groups of channels() columns) with an open column are multiplied; the
  /// columns of the others are 0. Counts nothing: see spend_products().
  Field multiply_open(const Field& X) const;

  /// Records ||E - (I - T) B||_A of a column, computed from the B that radiosity() shows; closes the column
  /// if it is small enough. Throws Error if B is so large that the system is numerically singular. Columns
  /// may close at once: iterate over a copy of open_columns().
  void accept_residual(Index column, double residual_norm);

  /// Relative residual of a column as last accepted; 1 before that (B = 0).
  double accepted_residual(Index column) const { return relative_residuals_[column]; }

  /// Announces `count` products; throws Error if they exceed the budget.
  void spend_products(int count = 1);

  /// Smallest eigenvalue of I - T, relative to its largest, that rounding lets one tell from zero: 8 sqrt(n)
  /// u.
  double singularity_threshold() const;

  [[noreturn]] void fail_as_singular() const;

  /// The residual norm that the rounding of an operator in float32 leaves: u ||B||_A, u its roundoff; 0 for
  /// operators in double, whose iterations find out by themselves.
  double rounding_floor(Index column) const;

  /// For an iteration that gets no closer. An operator that multiplies in float32 and has brought the
  /// residual down to 8 u ||B||_A, u its roundoff, has given all that it can: the column closes, and
  /// residual() says where it stands. Otherwise throws Error: for rounding if that explains the residual,
  /// else as singular or stagnated.
  void end_stagnated(Index column);

 private:
  void refuse_room_without_absorption() const;
  void refuse_growing_light();

  std::string name_;
  SolverProblem problem_;
  Field emission_;
  Field radiosity_;
  Eigen::RowVectorXd emission_norms_;
  Eigen::RowVectorXd relative_residuals_;
  std::vector<Index> open_;
  int products_ = 0;
  bool growth_examined_ = false;
};

/// u = 2^-53, the unit roundoff of double.
inline constexpr double double_roundoff = std::numeric_limits<double>::epsilon() / 2;

}  // namespace radiosity
