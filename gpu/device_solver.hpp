#pragma once

#include "gpu/device_iteration.hpp"
#include "gpu/device_operator.hpp"
#include "solvers/stepped_solver.hpp"

#include <memory>

namespace radiosity {

/// Solves B = E + T B in rounds: the residual, in double precision, goes to the device, which solves for the
/// correction of B in float32 and keeps every field there (DeviceIteration); B is corrected on the CPU and
/// its residual computed as every solver's is. One round is enough as a rule: fields travel at its beginning
/// and at its end, in between only norms, a number a column, once for several steps. All columns go in
/// lockstep.
class DeviceSolver : public SteppedSolver {
 public:
  /// "cg:fields=device".
  std::string describe() const final { return name() + ":fields=device"; }
  /// Fetched from the device where a round is going on.
  const Field& radiosity() const final;

 protected:
  /// When a round of steps ends.
  struct RoundLimits {
    double reduction;  ///< of the residual: float32 gives no more
    int steps;         ///< without coming there
  };

  /// Throws UsageError for operators that are not on a device in one piece.
  DeviceSolver(const std::string& name, const SolverProblem& problem);

  virtual std::unique_ptr<DeviceIteration> make_iteration(const DeviceTransport& on_device) const = 0;
  /// Before every solution. Announces products that it takes; throws Error where the method does not
  /// converge.
  virtual RoundLimits round_limits() = 0;

 private:
  void begin() final;
  void advance() final;
  void begin_round();
  void end_round();
  /// To which the residual of a column is to fall in this round.
  double wanted_norm(Index column) const;
  bool round_has_ended() const;
  void plan_steps(const Eigen::RowVectorXd& norms_before, int steps_between);

  std::unique_ptr<DeviceIteration> iteration_;
  Eigen::ArrayXXd left_;  ///< of the transport that it was made with
  RoundLimits limits_{};
  Field residual_;            ///< E - (I - T) B, n x c; 0 in columns that are closed
  Eigen::RowVectorXd norms_;  ///< of the residual on the device
  bool in_round_ = false;
  int steps_ = 0;       ///< of this round
  int next_steps_ = 0;  ///< until norms are looked at
  mutable Field shown_;
};

/// Whether the solvers below take an operator.
bool solvable_on_device(const LinearOperator& transport);

/// The Neumann series on the device.
class DeviceNeumann final : public DeviceSolver {
 public:
  explicit DeviceNeumann(const SolverProblem& problem) : DeviceSolver("neumann", problem) {}

 private:
  std::unique_ptr<DeviceIteration> make_iteration(const DeviceTransport& on_device) const override;
  RoundLimits round_limits() override;
};

/// Conjugate gradients on the device. Throws UsageError for operators that are not symmetric kernels.
class DeviceConjugateGradients final : public DeviceSolver {
 public:
  explicit DeviceConjugateGradients(const SolverProblem& problem);

 private:
  std::unique_ptr<DeviceIteration> make_iteration(const DeviceTransport& on_device) const override;
  RoundLimits round_limits() override;

  const KernelOperator& kernel_;
};

}  // namespace radiosity
