#include "solvers/woodbury.hpp"

#include "foundation/error.hpp"
#include "foundation/hash.hpp"

#include <span>
#include <utility>

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

std::uint64_t fingerprint_of(const Eigen::MatrixXd& matrix) {
  Fingerprint hash;
  hash.add(std::span<const double>(matrix.data(), static_cast<std::size_t>(matrix.size())));
  return hash.value();
}

}  // namespace

Woodbury::Woodbury(const SolverProblem& problem)
    : SteppedSolver("woodbury", problem), factors_(require_low_rank(problem.transport)) {}

void Woodbury::begin() {
  const std::uint64_t reflectance = fingerprint_of(factors_.albedo());
  if (!capacitances_ || reflectance_ != reflectance) {
    reflectance_ = reflectance;
    capacitances_.emplace(factors_);
  }
  if (capacitances_->singular()) fail_as_singular();
  residuals_.resize(0, 0);
  steps_ = 0;
}

// A field of many million patches is a good part of an operator's memory: the answer is computed where it
// stays.
void Woodbury::correct(const std::vector<Index>& columns) {
  const Field& residuals = steps_ == 0 ? emission() : residuals_;
  const auto count = static_cast<Index>(columns.size());
  const bool all = count == residuals.cols();
  Field coefficients(factors_.rank(), count);
  if (all)
    factors_.multiply_right_transposed(residuals, coefficients);
  else
    factors_.multiply_right_transposed(Field(residuals(Eigen::all, columns)), coefficients);
  for (Index k = 0; k < count; ++k)
    coefficients.col(k) = capacitances_->of_channel(columns[static_cast<std::size_t>(k)] % channels())
                              .solve(coefficients.col(k));
  Field& B = mutable_radiosity();
  const bool in_place = all && steps_ == 0;
  Field correction;
  if (!in_place) correction.resize(size(), count);
  Field& reflected = in_place ? B : correction;
  factors_.multiply_left(coefficients, reflected);
  for (Index k = 0; k < count; ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    const auto rho = factors_.albedo().col(j % channels()).array();
    if (in_place)
      B.col(j).array() = residuals.col(j).array() + rho * B.col(j).array();
    else
      B.col(j).array() += residuals.col(j).array() + rho * reflected.col(k).array();
  }
}

void Woodbury::advance() {
  if (steps_ > 0) spend_products();
  const std::vector<Index> columns = open_columns();
  correct(columns);
  Field residuals = multiply_open(radiosity());
  for (const Index j : columns) {
    residuals.col(j) += emission().col(j) - radiosity().col(j);
    const double before = accepted_residual(j);
    const double norm = root_area().cwiseProduct(residuals.col(j)).norm();
    accept_residual(j, norm);
    if (!small_enough(j, norm) && steps_ > 0 && accepted_residual(j) > 0.5 * before) end_stagnated(j);
  }
  residuals_ = std::move(residuals);
  ++steps_;
}

}  // namespace radiosity
