#include "gpu/device_solver.hpp"

#include "foundation/error.hpp"
#include "gpu/conjugate_gradients_on_device.hpp"
#include "gpu/neumann_on_device.hpp"
#include "solvers/neumann.hpp"
#include "solvers/symmetric_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr int first_steps = 4;
constexpr int most_steps_at_once = 16;
/// Of the tolerance: what the products of the CPU and of the device differ by has to fit in as well.
constexpr double part_of_tolerance = 0.5;
constexpr double float_precision = 0x1p-22;  ///< that rounds reach, relative to what they start from

}  // namespace

bool solvable_on_device(const LinearOperator& transport) {
  return transport_on_device(transport).has_value();
}

DeviceSolver::DeviceSolver(const std::string& name, const SolverProblem& problem)
    : SteppedSolver(name, problem) {
  if (!solvable_on_device(problem.transport))
    fail<UsageError>(
        "{}:fields=device: {} has no form in one piece and in float32 on a device: take fields=cpu", name,
        problem.transport.describe());
}

void DeviceSolver::begin() {
  const DeviceTransport on_device = transport_on_device(transport()).value();
  const bool same = iteration_ && (on_device.left == left_).all();
  if (!same) {
    iteration_ = make_iteration(on_device);
    left_ = on_device.left;
  }
  limits_ = round_limits();
  residual_ = emission();
  in_round_ = false;
}

void DeviceSolver::advance() {
  if (!in_round_) begin_round();
  const int steps = std::clamp(options().max_products - products(), 1, next_steps_);
  spend_products(steps);
  const Eigen::RowVectorXd before = norms_;
  norms_ = iteration_->advance(steps);
  steps_ += steps;
  if (round_has_ended())
    end_round();
  else
    plan_steps(before, steps);
}

void DeviceSolver::begin_round() {
  spend_products(iteration_->starting_products());
  iteration_->start(residual_);
  norms_ = area_norms(root_area(), residual_);
  next_steps_ = first_steps;
  steps_ = 0;
  in_round_ = true;
}

double DeviceSolver::wanted_norm(Index column) const {
  const double begun_with = accepted_residual(column) * emission_norm(column);
  return std::max(part_of_tolerance * options().tolerance * emission_norm(column),
                  limits_.reduction * begun_with);
}

bool DeviceSolver::round_has_ended() const {
  if (steps_ >= limits_.steps) return true;
  const auto& open = open_columns();
  return std::none_of(open.begin(), open.end(), [&](Index j) { return norms_[j] > wanted_norm(j); });
}

/// As many as are needed if the residual goes on to fall as it did.
void DeviceSolver::plan_steps(const Eigen::RowVectorXd& norms_before, int steps_between) {
  double needed = 1;
  for (const Index j : open_columns()) {
    if (!(norms_[j] > wanted_norm(j))) continue;
    const double rate = std::log(norms_[j] / norms_before[j]) / steps_between;
    const double rest = std::log(wanted_norm(j) / norms_[j]);
    needed = std::max(needed, rate < 0 ? std::ceil(rest / rate) : most_steps_at_once);
  }
  next_steps_ = static_cast<int>(std::min<double>(needed, most_steps_at_once));
}

void DeviceSolver::end_round() {
  in_round_ = false;
  const Field correction = iteration_->solution();
  const std::vector<Index> columns = open_columns();
  for (const Index j : columns) mutable_radiosity().col(j) += correction.col(j);
  spend_products();
  const Field& corrected = mutable_radiosity();
  const Field gathered = multiply_open(corrected);
  residual_.setZero();
  for (const Index j : columns) {
    const double before = accepted_residual(j);
    residual_.col(j) = emission().col(j) + gathered.col(j) - corrected.col(j);
    const double norm = root_area().cwiseProduct(residual_.col(j)).norm();
    accept_residual(j, norm);
    if (small_enough(j, norm)) {
      residual_.col(j).setZero();
    } else if (norm <= 4 * rounding_floor(j) || accepted_residual(j) > before / 2) {
      end_stagnated(j);
      residual_.col(j).setZero();
    }
  }
}

const Field& DeviceSolver::radiosity() const {
  const Field& so_far = SteppedSolver::radiosity();
  if (!in_round_) return so_far;
  shown_ = so_far + iteration_->solution();
  return shown_;
}

std::unique_ptr<DeviceIteration> DeviceNeumann::make_iteration(const DeviceTransport& on_device) const {
  return std::make_unique<NeumannOnDevice>(on_device, root_area());
}

DeviceSolver::RoundLimits DeviceNeumann::round_limits() {
  const NeumannForecast forecast = forecast_neumann(transport(), options());
  spend_products(forecast.products);
  // Changes below the rounding of D, which is up to 1 / (1 - bound) of the right-hand side, are noise; the
  // bound holds in another norm, as in Neumann.
  return {std::min(float_precision / (1 - forecast.bound), 0.25), 2 * forecast.steps + 50};
}

DeviceConjugateGradients::DeviceConjugateGradients(const SolverProblem& problem)
    : DeviceSolver("cg", problem), kernel_(require_symmetric_kernel("cg", problem.transport)) {}

std::unique_ptr<DeviceIteration> DeviceConjugateGradients::make_iteration(
    const DeviceTransport& on_device) const {
  return std::make_unique<ConjugateGradientsOnDevice>(on_device, kernel_);
}

DeviceSolver::RoundLimits DeviceConjugateGradients::round_limits() {
  return {float_precision, static_cast<int>(std::min<Index>(50 + size(), options().max_products))};
}

}  // namespace radiosity
