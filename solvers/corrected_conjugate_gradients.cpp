#include "solvers/corrected_conjugate_gradients.hpp"

#include "foundation/error.hpp"
#include "solvers/symmetric_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

constexpr double inner_tolerance = 1e-3;
constexpr int most_inner_steps = 300;

std::unique_ptr<LinearOperator> make_preconditioner(const SolverProblem& problem, const std::string& spec) {
  if (!problem.make_operator)
    fail<UsageError>("cg:preconditioner={} needs form factors to build that operator from; use cg", spec);
  return problem.make_operator(spec);
}

/// Conjugate gradients for (I - S~) z = r from z = 0, one column, advanced from outside.
struct InnerSolution {
  Eigen::VectorXd z, r, p;
  double squared = 0;
  double wanted = 0;
  bool done = false;

  explicit InnerSolution(const Eigen::VectorXd& residual)
      : z(Eigen::VectorXd::Zero(residual.size())), r(residual), p(residual), squared(r.squaredNorm()) {
    wanted = inner_tolerance * inner_tolerance * squared;
    done = squared == 0;
  }

  void advance(const Eigen::VectorXd& image) {
    const double curvature = p.dot(image);
    if (!(curvature > 0)) {
      done = true;
      return;
    }
    const double length = squared / curvature;
    z += length * p;
    r -= length * image;
    const double next = r.squaredNorm();
    p = r + next / squared * p;
    squared = next;
    done = squared <= wanted;
  }
};

}  // namespace

CorrectedConjugateGradients::CorrectedConjugateGradients(const SolverProblem& problem,
                                                         const std::string& preconditioner)
    : SteppedSolver("cg", problem),
      spec_(preconditioner),
      approximation_(make_preconditioner(problem, preconditioner)),
      kernel_(require_symmetric_kernel("cg", problem.transport)),
      other_(require_symmetric_kernel("cg:preconditioner", *approximation_)) {}

void CorrectedConjugateGradients::begin() {
  root_reflectance_ = kernel_.reflectance().cwiseSqrt();
  solution_ = Field::Zero(size(), emission().cols());
  residual_ = solution_;
  direction_ = solution_;
  image_ = solution_;
  columns_.assign(static_cast<std::size_t>(emission().cols()), Column{});
  for (const Index j : open_columns()) show_radiosity(j);
}

void CorrectedConjugateGradients::advance() {
  spend_products();
  const std::vector<Index> columns = open_columns();
  Field inputs(size(), static_cast<Index>(columns.size()));
  Field outputs(size(), inputs.cols());
  for (Index k = 0; k < inputs.cols(); ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    if (columns_[static_cast<std::size_t>(j)].next == Next::evaluate)
      inputs.col(k) = root_area().cwiseProduct(radiosity().col(j));
    else
      inputs.col(k) = root_reflectance_.col(j % channels()).cwiseProduct(direction_.col(j));
  }
  kernel_.apply_kernel(inputs, outputs);
  std::vector<Index> going_on;
  for (Index k = 0; k < inputs.cols(); ++k) {
    const Index j = columns[static_cast<std::size_t>(k)];
    const bool evaluating = columns_[static_cast<std::size_t>(j)].next == Next::evaluate;
    if (evaluating ? evaluate(j, outputs.col(k)) : iterate(j, outputs.col(k))) going_on.push_back(j);
  }
  renew_directions(going_on);
}

bool CorrectedConjugateGradients::evaluate(Index j, const Eigen::VectorXd& kernel_product) {
  Column& column = columns_[static_cast<std::size_t>(j)];
  const auto root = root_reflectance_.col(j % channels());
  const double before = accepted_residual(j);
  const Eigen::VectorXd scattered = root.cwiseProduct(kernel_product);
  const Eigen::VectorXd defect =
      root_area().cwiseProduct(emission().col(j) - radiosity().col(j)) + root.cwiseProduct(scattered);
  const double defect_norm = defect.norm();
  accept_residual(j, defect_norm);
  if (small_enough(j, defect_norm)) return false;
  const bool gained = !column.started || accepted_residual(j) < 0.5 * before;
  column.fruitless_evaluations = gained ? 0 : column.fruitless_evaluations + 1;
  residual_.col(j) = scattered - solution_.col(j);
  if (column.fruitless_evaluations >= 2 || residual_.col(j).squaredNorm() == 0) fail_as_stagnated(j);
  image_.col(j).setZero();
  column.started = true;
  column.next = Next::iterate;
  return true;
}

bool CorrectedConjugateGradients::iterate(Index j, const Eigen::VectorXd& kernel_product) {
  Column& column = columns_[static_cast<std::size_t>(j)];
  const auto root = root_reflectance_.col(j % channels());
  image_.col(j) = direction_.col(j) - root.cwiseProduct(kernel_product);
  const double curvature = direction_.col(j).dot(image_.col(j));
  if (!(curvature > singularity_threshold() * direction_.col(j).squaredNorm())) fail_as_singular();
  const double length = direction_.col(j).dot(residual_.col(j)) / curvature;
  solution_.col(j) += length * direction_.col(j);
  residual_.col(j) -= length * image_.col(j);
  show_radiosity(j);
  const double recurred = root.cwiseProduct(residual_.col(j)).norm();
  const bool noise = recurred <= unit_roundoff * root.cwiseProduct(solution_.col(j)).norm();
  if (!small_enough(j, recurred) && !noise) return true;
  column.next = Next::evaluate;
  return false;
}

void CorrectedConjugateGradients::renew_directions(const std::vector<Index>& columns) {
  if (columns.empty()) return;
  const Field improved = precondition(columns);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Index j = columns[k];
    Eigen::VectorXd z = improved.col(static_cast<Index>(k));
    if (!(z.dot(residual_.col(j)) > 0)) z = residual_.col(j);
    const double curvature = direction_.col(j).dot(image_.col(j));
    if (curvature > 0)
      direction_.col(j) = z - z.dot(image_.col(j)) / curvature * direction_.col(j);
    else
      direction_.col(j) = z;
  }
}

Field CorrectedConjugateGradients::precondition(const std::vector<Index>& columns) const {
  std::vector<InnerSolution> inner;
  for (const Index j : columns) inner.emplace_back(residual_.col(j));
  for (int step = 0; step < most_inner_steps; ++step) {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < inner.size(); ++k)
      if (!inner[k].done) open.push_back(k);
    if (open.empty()) break;
    Field inputs(size(), static_cast<Index>(open.size()));
    Field outputs(size(), inputs.cols());
    for (std::size_t o = 0; o < open.size(); ++o)
      inputs.col(static_cast<Index>(o)) =
          root_reflectance_.col(columns[open[o]] % channels()).cwiseProduct(inner[open[o]].p);
    other_.apply_kernel(inputs, outputs);
    for (std::size_t o = 0; o < open.size(); ++o) {
      const auto root = root_reflectance_.col(columns[open[o]] % channels());
      inner[open[o]].advance(inner[open[o]].p - root.cwiseProduct(outputs.col(static_cast<Index>(o))));
    }
  }
  Field solutions(size(), static_cast<Index>(inner.size()));
  for (std::size_t k = 0; k < inner.size(); ++k) solutions.col(static_cast<Index>(k)) = inner[k].z;
  return solutions;
}

void CorrectedConjugateGradients::show_radiosity(Index j) {
  const auto root = root_reflectance_.col(j % channels());
  mutable_radiosity().col(j) =
      emission().col(j) + root.cwiseProduct(solution_.col(j)).cwiseQuotient(root_area());
}

}  // namespace radiosity
