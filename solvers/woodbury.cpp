#include "solvers/woodbury.hpp"

#include "foundation/error.hpp"
#include "foundation/hash.hpp"

#include <numeric>
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

/// (I - V' R U)^-1 V' X; `columns` says which column of the emission each of X belongs to.
Field Woodbury::coefficients(const ConstFieldRef& fields, const std::vector<Index>& columns) const {
  Field result(factors_.rank(), fields.cols());
  factors_.multiply_right_transposed(fields, result);
  for (Index k = 0; k < fields.cols(); ++k)
    result.col(k) =
        capacitances_->of_channel(columns[static_cast<std::size_t>(k)] % channels()).solve(result.col(k));
  return result;
}

// In place: a field of many million patches is a good part of an operator's memory.
void Woodbury::answer() {
  std::vector<Index> columns(static_cast<std::size_t>(emission().cols()));
  std::iota(columns.begin(), columns.end(), Index{0});
  Field& B = mutable_radiosity();
  factors_.multiply_left(coefficients(emission(), columns), B);
  for (Index j = 0; j < B.cols(); ++j)
    B.col(j) = emission().col(j) + factors_.albedo().col(j % channels()).cwiseProduct(B.col(j));
}

void Woodbury::refine(const std::vector<Index>& columns) {
  const Field residuals = residuals_(Eigen::all, columns);
  Field reflected(size(), residuals.cols());
  factors_.multiply_left(coefficients(residuals, columns), reflected);
  for (Index k = 0; k < residuals.cols(); ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    mutable_radiosity().col(j) +=
        residuals.col(k) + factors_.albedo().col(j % channels()).cwiseProduct(reflected.col(k));
  }
}

void Woodbury::advance() {
  const std::vector<Index> columns = open_columns();
  if (steps_ == 0) {
    answer();
  } else {
    spend_products();
    refine(columns);
  }
  Field residuals = multiply_open(radiosity());
  for (const Index j : columns) {
    residuals.col(j) += emission().col(j) - radiosity().col(j);
    const double before = accepted_residual(j);
    const double norm = root_area().cwiseProduct(residuals.col(j)).norm();
    accept_residual(j, norm);
    if (!small_enough(j, norm) && steps_ > 0 && accepted_residual(j) > 0.5 * before) end_stagnated(j);
  }
  residuals_ = open_columns().empty() ? Field() : std::move(residuals);
  ++steps_;
}

}  // namespace radiosity
