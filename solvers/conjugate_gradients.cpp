#include "solvers/conjugate_gradients.hpp"

#include "solvers/symmetric_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

ConjugateGradients::ConjugateGradients(const SolverProblem& problem, const std::string& preconditioner)
    : SteppedSolver("cg", problem), kernel_(require_symmetric_kernel("cg", problem.transport)) {
  if (!preconditioner.empty()) preconditioner_.emplace(problem, preconditioner);
}

std::string ConjugateGradients::describe() const {
  return preconditioner_ ? "cg:preconditioner=" + preconditioner_->spec() : "cg";
}

void ConjugateGradients::begin() {
  root_reflectance_ = kernel_.reflectance().cwiseSqrt();
  solution_ = Field::Zero(size(), emission().cols());
  residual_ = solution_;
  direction_ = solution_;
  image_ = solution_;
  columns_.assign(static_cast<std::size_t>(emission().cols()), Column{});
  for (const Index j : open_columns()) show_radiosity(j);
}

void ConjugateGradients::advance() {
  spend_products();
  const std::vector<Index> columns = open_columns();
  Field inputs(size(), static_cast<Index>(columns.size()));
  Field outputs(size(), inputs.cols());
  for (Index k = 0; k < inputs.cols(); ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    const auto root = root_reflectance_.col(j % channels());
    if (columns_[static_cast<std::size_t>(j)].next == Next::evaluate)
      inputs.col(k) = root_area().cwiseProduct(radiosity().col(j));
    else
      inputs.col(k) = root.cwiseProduct(direction_.col(j));
  }
  kernel_.apply_kernel(inputs, outputs);
  for (Index k = 0; k < inputs.cols(); ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    if (columns_[static_cast<std::size_t>(j)].next == Next::evaluate)
      evaluate(j, outputs.col(k));
    else
      iterate(j, outputs.col(k));
  }
  std::vector<Index> going_on;
  for (const Index j : open_columns())
    if (columns_[static_cast<std::size_t>(j)].next == Next::iterate) going_on.push_back(j);
  renew_directions(going_on);
}

void ConjugateGradients::evaluate(Index j, const Eigen::VectorXd& kernel_product) {
  Column& column = columns_[static_cast<std::size_t>(j)];
  const auto root = root_reflectance_.col(j % channels());
  const double before = accepted_residual(j);
  const Eigen::VectorXd scattered = root.cwiseProduct(kernel_product);  // R^{1/2} K b

  // The residual of the radiosity as it is stored, rounding of b = e + R^{1/2} w included.
  const Eigen::VectorXd defect =
      root_area().cwiseProduct(emission().col(j) - radiosity().col(j)) + root.cwiseProduct(scattered);
  const double defect_norm = defect.norm();
  accept_residual(j, defect_norm);
  if (small_enough(j, defect_norm)) return;
  if (column.evaluated && defect_norm <= 4 * rounding_floor(j)) {
    end_stagnated(j);
    return;
  }

  // A second start from here is a residual correction: worth while as long as it gains something.
  const bool gained = !column.evaluated || accepted_residual(j) < 0.5 * before;
  column.fruitless_evaluations = gained ? 0 : column.fruitless_evaluations + 1;
  column.evaluated = true;
  residual_.col(j) = scattered - solution_.col(j);
  // No residual at all: only rounding is left, and the tolerance is below it.
  if (column.fruitless_evaluations >= 2 || residual_.col(j).isZero(0)) {
    end_stagnated(j);
    return;
  }
  column.curvature = 0;
  column.smallest_residual = defect_norm;
  column.steps_without_progress = 0;
  column.next = Next::iterate;
}

void ConjugateGradients::iterate(Index j, const Eigen::VectorXd& kernel_product) {
  Column& column = columns_[static_cast<std::size_t>(j)];
  const auto root = root_reflectance_.col(j % channels());
  image_.col(j) = direction_.col(j) - root.cwiseProduct(kernel_product);
  column.curvature = direction_.col(j).dot(image_.col(j));
  if (!(column.curvature > singularity_threshold() * direction_.col(j).squaredNorm())) fail_as_singular();

  const double step_length = direction_.col(j).dot(residual_.col(j)) / column.curvature;
  solution_.col(j) += step_length * direction_.col(j);
  residual_.col(j) -= step_length * image_.col(j);
  show_radiosity(j);

  const double recurred = root.cwiseProduct(residual_.col(j)).norm();
  column.steps_without_progress = recurred < column.smallest_residual ? 0 : column.steps_without_progress + 1;
  column.smallest_residual = std::min(column.smallest_residual, recurred);
  const bool stuck = column.steps_without_progress > 50 + size();
  // Beyond the rounding of the products the recurrence goes on to fall, and the true residual does not.
  const bool enough = small_enough(j, recurred) || recurred <= rounding_floor(j);
  if (enough || residual_.col(j).isZero(0) || stuck) column.next = Next::evaluate;
}

void ConjugateGradients::renew_directions(const std::vector<Index>& columns) {
  if (columns.empty()) return;
  Field improved = residual_(Eigen::all, columns);
  if (preconditioner_) {
    std::vector<Index> channel;
    channel.reserve(columns.size());
    for (const Index j : columns) channel.push_back(j % channels());
    improved = (*preconditioner_)(improved, channel, root_reflectance_);
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Index j = columns[k];
    const double curvature = columns_[static_cast<std::size_t>(j)].curvature;
    auto z = improved.col(static_cast<Index>(k));
    if (!(z.dot(residual_.col(j)) > 0)) z = residual_.col(j);
    if (curvature > 0) z -= z.dot(image_.col(j)) / curvature * direction_.col(j);
    direction_.col(j) = z;
  }
}

void ConjugateGradients::show_radiosity(Index j) {
  const auto root = root_reflectance_.col(j % channels());
  mutable_radiosity().col(j) =
      emission().col(j) + root.cwiseProduct(solution_.col(j)).cwiseQuotient(root_area());
}

}  // namespace radiosity
