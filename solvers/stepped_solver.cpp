#include "solvers/stepped_solver.hpp"

#include "foundation/error.hpp"
#include "operators/low_rank_operator.hpp"
#include "solvers/spectral_radius.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {

SteppedSolver::SteppedSolver(std::string name, const SolverProblem& problem)
    : name_(std::move(name)), problem_(problem) {
  require_transport(name_, transport());
  if (size() != transport().size())
    fail<UsageError>("{}: {} areas were given for an operator of {} patches.", name_, size(),
                     transport().size());
  if (!problem_.root_area.allFinite() || (size() > 0 && problem_.root_area.minCoeff() <= 0))
    fail<UsageError>("{}: every patch needs a positive, finite area.", name_);
  if (!(options().tolerance > 0) || !std::isfinite(options().tolerance))
    fail<UsageError>("{}: the tolerance {} is not a positive number.", name_, options().tolerance);
  if (options().max_products < 1)
    fail<UsageError>("{}: a budget of {} products allows no iteration.", name_, options().max_products);
}

void SteppedSolver::start(const Field& emission) {
  check_emission(name_, transport(), emission);
  emission_ = emission;
  emission_norms_ = area_norms(root_area(), emission_);
  relative_residuals_ = Eigen::RowVectorXd::Zero(emission.cols());
  products_ = 0;
  open_.clear();
  for (Index j = 0; j < emission.cols(); ++j) {
    if (emission_norms_[j] == 0) continue;
    relative_residuals_[j] = 1;
    open_.push_back(j);
  }
  if (!open_.empty()) {
    refuse_room_without_absorption();
    refuse_growing_light();
  }
  radiosity_ = Field::Zero(emission.rows(), emission.cols());
  if (!open_.empty()) begin();
}

/// Where nothing absorbs and rows sum to 1 but for the error of F, the answer would be that error's alone.
void SteppedSolver::refuse_room_without_absorption() const {
  constexpr double form_factor_error = 1e-6;
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport());
  if (kernel == nullptr) return;
  const bool absorbs = std::none_of(open_.begin(), open_.end(), [&](Index j) {
    return kernel->reflectance().col(j % channels()).minCoeff() >= 1;
  });
  if (absorbs) return;
  Field gathered(size(), 1);
  kernel->apply_kernel(root_area(), gathered);
  const Eigen::VectorXd row_sums = gathered.col(0).cwiseQuotient(root_area());
  if ((row_sums.array() - 1).abs().maxCoeff() <= form_factor_error) fail_as_singular();
}

/// Where the spectral radius is known to be above 1, light grows without end and B = E + T B has no physical
/// answer, however well its equations can be solved. One product tells as a rule; examined once a solver, and
/// not for factors of low rank, whose signs leave no bound.
void SteppedSolver::refuse_growing_light() {
  if (growth_examined_) return;
  growth_examined_ = true;
  if (dynamic_cast<const LowRankFactors*>(&transport()) != nullptr) return;
  constexpr int few_products = 3;
  const double least = collatz_wielandt_bounds(transport(), few_products).lower;
  if (least <= 1 + singularity_threshold()) return;
  fail(
      "{}: the spectral radius of T is at least {:.6g}, so that light would grow at every bounce (row sums "
      "of an "
      "approximate F above 1): close the operator (closure=symmetric) or the form factors, or lower the "
      "reflectance.",
      name_, least);
}

void SteppedSolver::step() {
  if (!open_.empty()) advance();
}

double SteppedSolver::residual() const {
  return relative_residuals_.size() == 0 ? 0 : relative_residuals_.maxCoeff();
}

Field SteppedSolver::multiply_open(const Field& X) const {
  std::vector<Index> columns;
  Index last_light = -1;
  for (const Index j : open_) {
    const Index light = j / channels();
    if (light == last_light) continue;
    for (Index channel = 0; channel < channels(); ++channel) columns.push_back(light * channels() + channel);
    last_light = light;
  }
  Field images(X.rows(), X.cols());
  if (static_cast<Index>(columns.size()) == X.cols()) {
    transport().apply(X, images);
    return images;
  }
  images.setZero();
  const Field fields = X(Eigen::all, columns);
  Field open_images(fields.rows(), fields.cols());
  transport().apply(fields, open_images);
  images(Eigen::all, columns) = open_images;
  return images;
}

void SteppedSolver::accept_residual(Index column, double residual_norm) {
  relative_residuals_[column] = residual_norm / emission_norms_[column];
  const double radiosity_norm = root_area().cwiseProduct(radiosity_.col(column)).norm();
  const bool singular = !(radiosity_norm * singularity_threshold() < emission_norms_[column]);
  if (singular || !std::isfinite(residual_norm)) fail_as_singular();
  if (small_enough(column, residual_norm)) std::erase(open_, column);
}

void SteppedSolver::spend_products(int count) {
  if (products_ + count > options().max_products)
    fail(
        "{} has used its budget of {} products and stands at a relative residual of {:.3g} (wanted {:.3g}): "
        "allow more "
        "products, a larger tolerance, or use cg or gmres.",
        name_, options().max_products, residual(), options().tolerance);
  products_ += count;
}

double SteppedSolver::singularity_threshold() const {
  return 8 * std::sqrt(static_cast<double>(std::max<Index>(size(), 1))) * double_roundoff;
}

void SteppedSolver::fail_as_singular() const {
  fail(
      "{}: the system I - T is singular or not positive (a reflectance of 1 in a closed room, or row sums of "
      "an "
      "approximate F above 1): lower the reflectance (--max-reflectance) or close the form factors.",
      name_);
}

double SteppedSolver::rounding_floor(Index column) const {
  if (transport().product_roundoff() <= double_roundoff) return 0;
  return transport().product_roundoff() * root_area().cwiseProduct(radiosity_.col(column)).norm();
}

void SteppedSolver::end_stagnated(Index column) {
  const double radiosity_norm = root_area().cwiseProduct(radiosity_.col(column)).norm();
  const double by_rounding = double_roundoff * radiosity_norm / emission_norms_[column];
  const double by_products = transport().product_roundoff() * radiosity_norm / emission_norms_[column];
  const double reached = relative_residuals_[column];
  if (by_products > by_rounding && reached <= 8 * by_products) {
    std::erase(open_, column);
    return;
  }
  if (reached <= 1e3 * by_rounding)
    fail(
        "{}: the relative residual stays at {:.3g}, which is all that double precision gives for this nearly "
        "singular "
        "or very tight problem: ask for a tolerance above it (wanted {:.3g}).",
        name_, reached, options().tolerance);
  fail(
      "{}: the relative residual stays at {:.3g} (wanted {:.3g}) because the system is singular, nearly so, "
      "or "
      "unsuited to this solver: lower the reflectance, or use lu or a larger restart.",
      name_, reached, options().tolerance);
}

}  // namespace radiosity
