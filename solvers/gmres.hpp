#pragma once

#include "solvers/stepped_solver.hpp"

namespace radiosity {

/// Restarted GMRES (Saad and Schultz 1986) on (I - T) B = E in the area inner product, for any operator.
/// Modified Gram-Schmidt, orthogonalized twice, Givens rotations. All columns go in lockstep, one product a
/// step, each with its own Krylov space; the residual is computed afresh at every restart and before a column
/// is said to have converged. Memory: restart + 1 fields for each column.
class Gmres final : public SteppedSolver {
 public:
  /// restart >= 1: the largest dimension of the Krylov space.
  Gmres(const SolverProblem& problem, int restart);

  std::string describe() const override;

 private:
  /// The Krylov space of one column, in scaled coordinates A^{1/2} B where the area inner product is
  /// Euclidean.
  struct Column {
    Eigen::MatrixXd basis;     ///< n x (restart + 1), orthonormal
    Eigen::MatrixXd triangle;  ///< R of the rotated Hessenberg matrix, restart x restart
    Eigen::VectorXd cosines;   ///< Givens rotations
    Eigen::VectorXd sines;
    Eigen::VectorXd right_side;  ///< rotated, restart + 1; the last entry is the residual norm
    Eigen::VectorXd origin;      ///< A^{1/2} B at the last restart
    int dimension = 0;
    bool evaluate = false;  ///< the next product is with B, for the residual
    int fruitless_restarts = 0;
  };

  void begin() override;
  void advance() override;
  void evaluate(Index j, const Eigen::VectorXd& product);
  void expand(Index j, const Eigen::VectorXd& product);
  void restart(Column& column, const Eigen::VectorXd& residual);
  void rotate(Column& column, Eigen::VectorXd hessenberg, double below);
  void show_radiosity(Index j);

  int restart_;
  std::vector<Column> columns_;
};

}  // namespace radiosity
