#include "solvers/woodbury.hpp"

#include "foundation/error.hpp"

namespace radiosity {
namespace {

const LowRankFactors& require_low_rank(const LinearOperator& transport) {
  const auto* factors = dynamic_cast<const LowRankFactors*>(&transport);
  if (factors == nullptr)
    fail<UsageError>(
        "woodbury needs an operator of low rank, such as svd:k=64, which {} is not: use cg or gmres",
        transport.describe());
  return *factors;
}

}  // namespace

Woodbury::Woodbury(const SolverProblem& problem)
    : SteppedSolver("woodbury", problem), factors_(require_low_rank(problem.transport)) {}

void Woodbury::begin() {
  if (!capacitances_ || reflectance_ != factors_.albedo()) {
    reflectance_ = factors_.albedo();
    capacitances_.emplace(factors_);
  }
  if (capacitances_->singular()) fail_as_singular();
  residuals_ = emission();
  steps_ = 0;
}

void Woodbury::advance() {
  if (steps_ > 0) spend_products();
  const std::vector<Index> columns = open_columns();
  const Field fields = residuals_(Eigen::all, columns);
  Field coefficients(factors_.rank(), fields.cols());
  factors_.multiply_right_transposed(fields, coefficients);
  for (Index k = 0; k < fields.cols(); ++k)
    coefficients.col(k) = capacitances_->of_channel(columns[static_cast<std::size_t>(k)] % channels())
                              .solve(coefficients.col(k));
  Field reflected(size(), fields.cols());
  factors_.multiply_left(coefficients, reflected);
  for (Index k = 0; k < fields.cols(); ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    mutable_radiosity().col(j) +=
        fields.col(k) + reflectance_.col(j % channels()).cwiseProduct(reflected.col(k));
  }

  const Field gathered = multiply_open(radiosity());
  for (const Index j : columns) {
    residuals_.col(j) = emission().col(j) - radiosity().col(j) + gathered.col(j);
    const double before = accepted_residual(j);
    const double norm = root_area().cwiseProduct(residuals_.col(j)).norm();
    accept_residual(j, norm);
    if (!small_enough(j, norm) && steps_ > 0 && accepted_residual(j) > 0.5 * before) end_stagnated(j);
  }
  ++steps_;
}

}  // namespace radiosity
