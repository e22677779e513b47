#include "solvers/gmres.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {

Gmres::Gmres(const SolverProblem& problem, int restart) : SteppedSolver("gmres", problem), restart_(restart) {
  if (restart < 1) fail<UsageError>("gmres: restart={} leaves no Krylov space: use 1 or more.", restart);
}

std::string Gmres::describe() const {
  return fmt::format("gmres:restart={}", restart_);
}

void Gmres::begin() {
  columns_.assign(static_cast<std::size_t>(emission().cols()), Column{});
  for (const Index j : open_columns()) {
    Column& column = columns_[static_cast<std::size_t>(j)];
    const Index space = std::min<Index>(restart_, size());
    column.basis.resize(size(), space + 1);
    column.triangle = Eigen::MatrixXd::Zero(space, space);
    column.cosines = column.sines = Eigen::VectorXd::Zero(space);
    column.right_side = Eigen::VectorXd::Zero(space + 1);
    column.origin = Eigen::VectorXd::Zero(size());
    restart(column, root_area().cwiseProduct(emission().col(j)));  // B = 0 leaves the residual E
  }
}

void Gmres::advance() {
  spend_products();
  const std::vector<Index> open = open_columns();
  Field inputs = Field::Zero(size(), emission().cols());
  for (const Index j : open) {
    const Column& column = columns_[static_cast<std::size_t>(j)];
    if (column.evaluate)
      inputs.col(j) = radiosity().col(j);
    else
      inputs.col(j) = column.basis.col(column.dimension).cwiseQuotient(root_area());
  }
  const Field products = multiply_open(inputs);
  for (const Index j : open) {
    if (columns_[static_cast<std::size_t>(j)].evaluate)
      evaluate(j, products.col(j));
    else
      expand(j, products.col(j));
  }
}

void Gmres::evaluate(Index j, const Eigen::VectorXd& product) {
  Column& column = columns_[static_cast<std::size_t>(j)];
  const double before = accepted_residual(j);
  const Eigen::VectorXd residual = root_area().cwiseProduct(emission().col(j) - radiosity().col(j) + product);
  const double norm = residual.norm();
  accept_residual(j, norm);
  if (small_enough(j, norm)) return;
  // A slow cycle may be honest with a short restart; two that gain nothing are not.
  column.fruitless_restarts = accepted_residual(j) < 0.9999 * before ? 0 : column.fruitless_restarts + 1;
  if (column.fruitless_restarts >= 2) {
    end_stagnated(j);
    return;
  }
  column.origin = root_area().cwiseProduct(radiosity().col(j));
  restart(column, residual);
}

void Gmres::restart(Column& column, const Eigen::VectorXd& residual) {
  const double norm = residual.norm();
  column.basis.col(0) = residual / norm;
  column.right_side.setZero();
  column.right_side[0] = norm;
  column.dimension = 0;
  column.evaluate = false;
}

void Gmres::expand(Index j, const Eigen::VectorXd& product) {
  Column& column = columns_[static_cast<std::size_t>(j)];
  const Index k = column.dimension;
  Eigen::VectorXd next = column.basis.col(k) - root_area().cwiseProduct(product);  // (I - T) v_k
  const double length = next.norm();
  Eigen::VectorXd hessenberg = Eigen::VectorXd::Zero(k + 1);
  for (int pass = 0; pass < 2; ++pass)
    for (Index i = 0; i <= k; ++i) {
      const double along = column.basis.col(i).dot(next);
      hessenberg[i] += along;
      next -= along * column.basis.col(i);
    }
  // What is left of a vector that lies in the space already is rounding, of vectors of length 1 at least.
  double below = next.norm();
  if (below <= 4 * double_roundoff * std::max(1.0, length)) below = 0;
  if (below > 0) column.basis.col(k + 1) = next / below;
  rotate(column, std::move(hessenberg), below);
  if (!(std::abs(column.triangle(k, k)) > singularity_threshold())) fail_as_singular();
  column.dimension = static_cast<int>(k) + 1;
  show_radiosity(j);
  const double recurred = std::abs(column.right_side[k + 1]);
  column.evaluate = small_enough(j, recurred) || below == 0 || column.dimension == column.triangle.cols();
}

void Gmres::rotate(Column& column, Eigen::VectorXd hessenberg, double below) {
  const Index k = column.dimension;
  for (Index i = 0; i < k; ++i) {
    const double upper = hessenberg[i];
    hessenberg[i] = column.cosines[i] * upper + column.sines[i] * hessenberg[i + 1];
    hessenberg[i + 1] = -column.sines[i] * upper + column.cosines[i] * hessenberg[i + 1];
  }
  const double diagonal = std::hypot(hessenberg[k], below);
  column.cosines[k] = diagonal == 0 ? 1 : hessenberg[k] / diagonal;
  column.sines[k] = diagonal == 0 ? 0 : below / diagonal;
  hessenberg[k] = diagonal;
  column.triangle.col(k).head(k + 1) = hessenberg;
  const double top = column.right_side[k];
  column.right_side[k] = column.cosines[k] * top;
  column.right_side[k + 1] = -column.sines[k] * top;
}

void Gmres::show_radiosity(Index j) {
  const Column& column = columns_[static_cast<std::size_t>(j)];
  const Index k = column.dimension;
  Eigen::VectorXd weights = column.right_side.head(k);
  for (Index i = k - 1; i >= 0; --i) {  // R weights = right side, from the last row up
    for (Index l = i + 1; l < k; ++l) weights[i] -= column.triangle(i, l) * weights[l];
    weights[i] /= column.triangle(i, i);
  }
  const Eigen::VectorXd scaled = column.origin + column.basis.leftCols(k) * weights;
  mutable_radiosity().col(j) = scaled.cwiseQuotient(root_area());
}

}  // namespace radiosity
