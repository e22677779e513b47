#pragma once

#include "operators/kernel_operator.hpp"
#include "operators/linear_operator.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>

namespace radiosity {

/// Solves B = E + T B for every column of E at once. Steppable: iterations may be spread over frames (003,
/// section 3.3.2).
///
///   solver->start(E);                       // n x c, W/m^2, c a multiple of the operator's channels
///   while (!solver->converged()) solver->step();
///   const Field& B = solver->radiosity();   // usable after every step
///
/// Every solver stops on the relative residual ||E - (I - T) B|| / ||E|| of the area norm, computed (not
/// recurred) before it says that it has converged. With an operator that multiplies in float32 it also ends
/// where rounding lets the residual fall no further (LinearOperator::product_roundoff): residual() tells.
/// What it cannot solve it refuses with an Error: a singular system (rho = 1 in a closed room), a diverging
/// iteration, a budget that would be exceeded.
class Solver {
 public:
  virtual ~Solver() = default;

  /// Begins with a new right-hand side; throws UsageError for wrong shapes and values that are not finite.
  virtual void start(const Field& emission) = 0;

  /// One iteration on every column that has not converged. Throws Error when it cannot go on.
  virtual void step() = 0;

  /// True once every column's relative residual is <= tolerance.
  virtual bool converged() const = 0;

  /// B so far, n x c, W/m^2.
  virtual const Field& radiosity() const = 0;

  /// Largest relative residual of any column as last computed; NaN where T is not known that it is computed
  /// with (DirectAnswer).
  virtual double residual() const = 0;

  /// Products with the operator used so far for the column that needed most (all columns of a product count
  /// once).
  virtual int products() const = 0;

  virtual std::string describe() const = 0;
};

struct SolverOptions {
  double tolerance = 1e-6;    ///< relative residual
  int max_products = 100000;  ///< more throws Error with the residual reached
  std::size_t matrix_bytes =
      std::size_t{8} << 30;  ///< most that solvers that read the entries of T (gauss-seidel, lu) may keep
};

/// Runs a solver to its end; returns B.
const Field& solve(Solver& solver, const Field& emission);

/// Throws UsageError, which opens with `name`, unless the emission is n x c with c a multiple of the
/// channels, and finite.
void check_emission(const std::string& name, const LinearOperator& transport, const Field& emission);

/// Throws UsageError for an operator that answers by itself; `name` is the solver's.
void require_transport(const std::string& name, const LinearOperator& transport);

/// The area norm ||X_j||_A = sqrt(sum_i A_i X_ij^2) of each column, given A^{1/2}.
Eigen::RowVectorXd area_norms(const Eigen::VectorXd& root_area, const ConstFieldRef& X);

}  // namespace radiosity
