#include "factorizations/leading_eigenpairs.hpp"

#include "factorizations/lapack.hpp"
#include "foundation/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index block_width = 3;    // what the kernels multiply in one pass
constexpr double tightness = 0.03;  // wanted (lambda - ritz) / (lambda - lowest) of the bound
constexpr double rank_tolerance = 1e-10;

/// Independent normal numbers (Box and Muller), so that every column is a uniformly random direction.
MatrixXd normal_matrix(Index rows, Index cols, std::uint64_t seed, std::uint64_t stream) {
  RandomStream random(seed, stream);
  MatrixXd numbers(rows, cols);
  for (Index i = 0; i < numbers.size(); ++i) {
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    numbers(i) = radius * std::cos(2 * std::numbers::pi * random.uniform());
  }
  return numbers;
}

/// Takes the span of `basis` out of X, twice for orthogonality to rounding.
void project_out(const Eigen::Ref<const MatrixXd>& basis, MatrixXd& X) {
  for (int pass = 0; pass < 2 && basis.cols() > 0; ++pass) X -= basis * (basis.transpose() * X);
}

/// One block Krylov space of Q S Q with the images of its basis under S.
class KrylovRun {
 public:
  KrylovRun(const BlockProduct& S, const MatrixXd& found, MatrixXd start)
      : S_(S), found_(found), basis_(found.rows(), 0), images_(found.rows(), 0) {
    append(std::move(start), 1);
  }

  bool exhausted() const { return next_.cols() == 0; }
  int products() const { return static_cast<int>(basis_.cols()); }

  void step() {
    const MatrixXd image = S_(next_);
    const Index old = basis_.cols();
    basis_.conservativeResize(Eigen::NoChange, old + next_.cols());
    images_.conservativeResize(Eigen::NoChange, old + next_.cols());
    basis_.rightCols(next_.cols()) = next_;
    images_.rightCols(next_.cols()) = image;
    append(image, image.norm());
  }

  /// Ritz values, rising, with their residual norms within the complement of what was found.
  void evaluate() {
    MatrixXd projected = basis_.transpose() * images_;
    projected = 0.5 * (projected + projected.transpose()).eval();
    SymmetricEigenpairs pairs = symmetric_eigenpairs(projected);
    values = std::move(pairs.values);
    coefficients = std::move(pairs.vectors);
  }

  VectorXd vector(Index ritz) const { return basis_ * coefficients.col(ritz); }
  VectorXd image(Index ritz) const { return images_ * coefficients.col(ritz); }
  double residual(Index ritz) const {
    MatrixXd defect = image(ritz) - values[ritz] * vector(ritz);
    if (found_.cols() > 0) defect -= found_ * (found_.transpose() * defect);
    return defect.norm();
  }

  VectorXd values;
  MatrixXd coefficients;

 private:
  void append(MatrixXd X, double scale) {
    project_out(found_, X);
    project_out(basis_, X);
    next_ = X.norm() <= rank_tolerance * std::max(scale, std::numeric_limits<double>::min())
                ? MatrixXd(X.rows(), 0)
                : orthonormal_columns(X);
    MatrixXd cleaned = next_;
    project_out(found_, cleaned);
    project_out(basis_, cleaned);
    if (cleaned.cols() > 0) next_ = orthonormal_columns(cleaned);
  }

  const BlockProduct& S_;
  const MatrixXd& found_;
  MatrixXd basis_;
  MatrixXd images_;
  MatrixXd next_;
};

/// sqrt(e) (2k - 1) >= this makes the bound fail for all columns of a block with probability 1 - confidence.
double bound_exponent(Index n, Index width, double confidence) {
  const double failure = std::pow(1 - confidence, 1.0 / static_cast<double>(width));
  return std::log(1.648 * std::sqrt(static_cast<double>(n)) / failure);
}

/// So many that the bound is as tight as it is wanted.
int enough_steps(double exponent) {
  return static_cast<int>(std::ceil(0.5 * (exponent / std::sqrt(tightness) + 1)));
}

class Search {
 public:
  Search(const BlockProduct& S, Index n, const EigenpairOptions& options)
      : S_(S), options_(options), vectors_(n, 0), images_(n, 0) {
    result_.smallest = std::numeric_limits<double>::infinity();
    result_.confidence = options.confidence;
  }

  LeadingEigenpairs run() {
    bool more = true;
    for (std::uint64_t round = 0; more; ++round) more = search_complement(round);
    finish();
    return result_;
  }

 private:
  Index size() const { return vectors_.rows(); }

  bool wanted(double theta) const {
    if (options_.wanted_value >= 0) return theta > options_.wanted_value;
    const double smallest = std::max(result_.smallest, options_.lowest);
    return (1 - smallest) > options_.wanted_ratio * (1 - theta);
  }

  /// One run from a random start; returns whether another one is needed.
  bool search_complement(std::uint64_t round) {
    const Index width = std::min(block_width, size() - vectors_.cols());
    if (width == 0) {
      result_.rest_bound = options_.lowest;
      return false;
    }
    const double exponent = bound_exponent(size(), width, options_.confidence);
    const int steps = enough_steps(exponent);
    KrylovRun krylov(S_, vectors_, normal_matrix(size(), width, options_.seed, round));
    int step = 0;
    bool unsettled = true;
    while (!krylov.exhausted() && (step < 4 * steps) && (step < steps || unsettled)) {
      krylov.step();
      if (++step % 4 != 0 && step < steps) continue;
      krylov.evaluate();
      result_.smallest = std::min(result_.smallest, krylov.values.minCoeff());
      unsettled = wanted_but_inaccurate(krylov);
      if (!unsettled && wanted(krylov.values.maxCoeff())) break;  // another run follows anyway
    }
    krylov.evaluate();
    result_.smallest = std::min(result_.smallest, krylov.values.minCoeff());
    result_.products += krylov.products();
    const Index before = vectors_.cols();
    keep_wanted(krylov);
    if (vectors_.cols() > before && vectors_.cols() < options_.most) return true;
    if (vectors_.cols() > before) return bound_rest_once_more(round);
    bound_rest(krylov, step, exponent);
    return false;
  }

  /// The room for pairs is used up: a last run only bounds what is left.
  bool bound_rest_once_more(std::uint64_t round) {
    full_ = true;
    return search_complement(round + 1);
  }

  bool wanted_but_inaccurate(const KrylovRun& krylov) const {
    if (full_) return false;
    for (Index ritz = krylov.values.size() - 1; ritz >= 0 && wanted(krylov.values[ritz]); --ritz)
      if (krylov.residual(ritz) > options_.accuracy) return true;
    return false;
  }

  void keep_wanted(const KrylovRun& krylov) {
    if (full_) return;
    for (Index ritz = krylov.values.size() - 1; ritz >= 0 && wanted(krylov.values[ritz]); --ritz) {
      if (vectors_.cols() >= options_.most) return;
      if (krylov.residual(ritz) > 4 * options_.accuracy) continue;
      vectors_.conservativeResize(Eigen::NoChange, vectors_.cols() + 1);
      images_.conservativeResize(Eigen::NoChange, images_.cols() + 1);
      vectors_.rightCols(1) = krylov.vector(ritz);
      images_.rightCols(1) = krylov.image(ritz);
    }
  }

  void bound_rest(const KrylovRun& krylov, int steps, double exponent) {
    const double largest = krylov.values.maxCoeff();
    const double rounding = 1e-13 * std::max(1.0, std::abs(largest));
    if (krylov.exhausted()) {
      result_.rest_bound = largest + rounding;
      return;
    }
    const double share = std::pow(exponent / (2 * steps - 1), 2);
    result_.rest_bound = share < 1 ? (largest - share * options_.lowest) / (1 - share) + rounding
                                   : std::numeric_limits<double>::infinity();
  }

  /// Rayleigh and Ritz over all that was kept.
  void finish() {
    result_.vectors = vectors_;
    if (vectors_.cols() == 0) return;
    MatrixXd projected = vectors_.transpose() * images_;
    projected = 0.5 * (projected + projected.transpose()).eval();
    const SymmetricEigenpairs pairs = symmetric_eigenpairs(projected);
    result_.values = pairs.values.reverse();
    const MatrixXd rotation = pairs.vectors.rowwise().reverse();
    result_.vectors = vectors_ * rotation;
    result_.residual = (images_ * rotation - result_.vectors * result_.values.asDiagonal()).norm();
  }

  const BlockProduct& S_;
  const EigenpairOptions& options_;
  MatrixXd vectors_;
  MatrixXd images_;
  bool full_ = false;
  LeadingEigenpairs result_;
};

}  // namespace

EigenvalueInterval eigenvalue_interval(const BlockProduct& S, Eigen::Index n, double confidence,
                                       std::uint64_t seed) {
  EigenvalueInterval interval;
  interval.confidence = confidence;
  if (n == 0) return interval;
  const Index width = std::min(block_width, n);
  const double exponent = bound_exponent(n, width, 1 - 0.5 * (1 - confidence));
  const int steps = enough_steps(exponent);
  const MatrixXd nothing(n, 0);
  KrylovRun krylov(S, nothing, normal_matrix(n, width, seed, 0));
  for (int step = 0; step < steps && !krylov.exhausted(); ++step) krylov.step();
  krylov.evaluate();
  const double least = krylov.values.minCoeff(), largest = krylov.values.maxCoeff();
  const double share = krylov.exhausted() ? 0 : std::pow(exponent / (2 * steps - 1), 2);
  const double margin =
      share / (1 - 2 * share) * (largest - least) + 1e-13 * std::max(std::abs(least), largest);
  interval.low = least - margin;
  interval.high = largest + margin;
  interval.smallest_ritz = least;
  interval.largest_ritz = largest;
  interval.products = krylov.products();
  return interval;
}

LeadingEigenpairs leading_eigenpairs(const BlockProduct& S, Eigen::Index n, const EigenpairOptions& options) {
  if (n == 0) return {};
  return Search(S, n, options).run();
}

}  // namespace radiosity
