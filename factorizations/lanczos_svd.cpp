#include "factorizations/lanczos_svd.hpp"

#include "factorizations/leading_eigenpairs.hpp"
#include "foundation/error.hpp"

#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <functional>

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double accuracy = 1e-13;  // of residuals, relative to the largest value
constexpr std::uint64_t norm_stream = 1000;

/// ||S||_2 from below, by some steps of power iteration: within a factor of 2 or so.
double estimate_norm(const BlockProduct& S, Index n, std::uint64_t seed) {
  constexpr int steps = 10;
  MatrixXd X = normal_numbers(n, 1, seed + norm_stream);
  double norm = 0;
  for (int step = 0; step < steps; ++step) {
    X /= X.stableNorm();
    X = S(X);
    norm = X.stableNorm();
    if (norm == 0) break;
  }
  if (!std::isfinite(norm)) fail("Lanczos: a product of the matrix is not finite");
  return norm;
}

/// Which end of the spectrum.
enum class Wanted { largest, largest_magnitude };

/// (I - Z Z') S (I - Z Z') / ||S|| as Spectra wants it. Spectra takes vectors shorter than 1e-16 sqrt(n) for
/// nothing, so that a matrix of norm 1 is what suits it; and it calls a value converged where its residual is
/// below a tolerance times the value, so that 1 is added where only the upper end is wanted: then small
/// values need no more than large ones, and cannot be asked for what rounding forbids.
class DeflatedOperator {
 public:
  using Scalar = double;

  DeflatedOperator(const BlockProduct& S, const MatrixXd& Z, double norm, Wanted wanted)
      : S_(S), Z_(Z), factor_(1 / norm), shift_(wanted == Wanted::largest ? 1 : 0) {}

  Index rows() const { return Z_.rows(); }
  Index cols() const { return Z_.rows(); }

  void perform_op(const double* x, double* y) const {
    const Eigen::Map<const VectorXd> input(x, rows());
    MatrixXd X = input;
    project_out_found(X);
    MatrixXd Y = factor_ * S_(X);
    project_out_found(Y);
    Eigen::Map<VectorXd>(y, rows()) = Y.col(0) + shift_ * input;
  }

 private:
  void project_out_found(MatrixXd& X) const {
    if (Z_.cols() > 0) X -= Z_ * (Z_.transpose() * X);
  }

  const BlockProduct& S_;
  const MatrixXd& Z_;
  double factor_;
  double shift_;
};

SymmetricEigenpairs largest(const SymmetricEigenpairs& rising, Index count) {
  count = std::min(count, static_cast<Index>(rising.values.size()));
  return {rising.values.tail(count).reverse(), rising.vectors.rightCols(count).rowwise().reverse()};
}

/// Eigenvectors of a symmetric S at the wanted end, found in rounds.
class RestartedSearch {
 public:
  RestartedSearch(const BlockProduct& S, Index n, Wanted wanted, const LanczosOptions& options)
      : S_(S), n_(n), wanted_(wanted), options_(options), norm_(estimate_norm(S, n, options.seed)) {
    pairs_.vectors.resize(n, 0);
  }

  /// The first min(rank, n - 1), what is largest first.
  SymmetricEigenpairs run() {
    constexpr int most_rounds = 20;
    constexpr Index at_least = 4;  // of the copies that later rounds look for
    const Index rank = std::min(options_.rank, n_ - 1);
    if (norm_ == 0) return {VectorXd::Zero(rank), MatrixXd::Identity(n_, rank)};
    for (int round = 0; round < most_rounds; ++round) {
      add(round == 0 ? rank : std::max(at_least, rank / 8), round);
      keep(rank);
      if (nothing_larger_is_left(round)) return pairs_;
    }
    fail("Lanczos: after {} rounds there still were values above the smallest of the {} kept", most_rounds,
         rank);
  }

 private:
  /// Eigenvectors of S in the complement of those found.
  void add(Index count, int round) {
    const Index space = n_ - pairs_.vectors.cols();
    count = std::min(count, space - 1);
    if (count < 1) return;
    const Index basis = options_.basis > 0 ? options_.basis : 2 * count + 20;
    DeflatedOperator deflated(S_, pairs_.vectors, norm_, wanted_);
    Spectra::SymEigsSolver<DeflatedOperator> solver(deflated, count, std::clamp(basis, count + 1, space));
    MatrixXd start = normal_numbers(n_, 1, options_.seed + static_cast<std::uint64_t>(round));
    if (pairs_.vectors.cols() > 0) start -= pairs_.vectors * (pairs_.vectors.transpose() * start);
    solver.init(start.data());
    const Index converged = solver.compute(
        wanted_ == Wanted::largest ? Spectra::SortRule::LargestAlge : Spectra::SortRule::LargestMagn,
        options_.restarts, 0.1 * accuracy);
    if (solver.info() != Spectra::CompInfo::Successful)
      fail(
          "Lanczos did not converge: {} of {} values after {} restarts and {} products; ask for fewer values "
          "or use a dense decomposition",
          converged, count, options_.restarts, solver.num_operations());
    MatrixXd together(n_, pairs_.vectors.cols() + count);
    together << pairs_.vectors, solver.eigenvectors();
    pairs_.vectors = pivoted_qr(together).Q;
  }

  /// Rayleigh and Ritz on all that was found; the first `rank` are kept.
  void keep(Index rank) {
    const MatrixXd projected = pairs_.vectors.transpose() * (S_(pairs_.vectors) / norm_);
    const SymmetricEigenpairs ritz = symmetric_eigenpairs(0.5 * (projected + projected.transpose()));
    const SymmetricEigenpairs first =
        wanted_ == Wanted::largest ? largest(ritz, rank) : largest_in_magnitude(ritz, rank);
    pairs_.values = norm_ * first.values;
    pairs_.vectors = pairs_.vectors * first.vectors;
  }

  bool nothing_larger_is_left(int round) const {
    constexpr double confidence = 0.999;
    constexpr double noticeable = 1e-6;
    if (pairs_.vectors.cols() == n_) return true;
    const BlockProduct rest = [&](const MatrixXd& X) {
      const auto& Z = pairs_.vectors;
      MatrixXd Y = S_(X - Z * (Z.transpose() * X)) / norm_;
      Y -= Z * (Z.transpose() * Y);
      return Y;
    };
    const double last = pairs_.values.tail(1)[0] / norm_;
    const double smallest = wanted_ == Wanted::largest ? last : std::abs(last);
    const double allowed = smallest + noticeable * std::abs(smallest) + accuracy;
    const EigenvalueInterval found =
        eigenvalue_interval(rest, n_, confidence, options_.seed + static_cast<std::uint64_t>(round));
    if (wanted_ == Wanted::largest) return found.largest_ritz <= allowed;
    return std::max(found.largest_ritz, -found.smallest_ritz) <= allowed;
  }

  const BlockProduct& S_;
  Index n_;
  Wanted wanted_;
  const LanczosOptions& options_;
  double norm_;
  SymmetricEigenpairs pairs_;
};

void require_lanczos_options(const LanczosOptions& options) {
  if (options.rank < 0 || options.basis < 0 || options.restarts < 1)
    fail<UsageError>("Lanczos for {} values with a basis of {} vectors and {} restarts: none may be negative",
                     options.rank, options.basis, options.restarts);
}

/// Throws where R = A V - U diag(values) or its transposed counterpart has a column that is too long.
void require_small_residual(const MatrixXd& residual, double largest) {
  if (residual.cols() == 0 || largest == 0) return;
  const double worst = (residual / largest).colwise().norm().maxCoeff();
  if (!(worst <= accuracy))
    fail("Lanczos did not converge: a residual is {:.1e} of the largest value, {:.0e} is allowed", worst,
         accuracy);
}

}  // namespace

SingularValues lanczos_svd(const MatrixProducts& A, const LanczosOptions& options) {
  require_lanczos_options(options);
  const Index m = A.rows, n = A.columns, rank = std::min({options.rank, m, n});
  if (rank == 0) return {MatrixXd(m, 0), VectorXd(0), MatrixXd(n, 0)};
  const BlockProduct augmented = [&](const MatrixXd& X) {
    MatrixXd Y(m + n, X.cols());
    Y.topRows(m) = A.apply(X.bottomRows(n));
    Y.bottomRows(n) = A.apply_transposed(X.topRows(m));
    return Y;
  };
  LanczosOptions wanted = options;
  wanted.rank = rank;
  const SymmetricEigenpairs pairs = RestartedSearch(augmented, m + n, Wanted::largest, wanted).run();
  // The lower halves of the eigenvectors span the right singular vectors, but where a value is 0 they need be
  // neither orthogonal nor of equal length: the values are those of A on that span.
  const MatrixXd V = pivoted_qr(pairs.vectors.bottomRows(n)).Q;
  const SingularValues small = singular_value_decomposition(A.apply(V));
  SingularValues svd{small.U, small.values, V * small.V};
  require_small_residual(A.apply_transposed(svd.U) - svd.V * svd.values.asDiagonal(), svd.values[0]);
  return svd;
}

SymmetricEigenpairs lanczos_eigenpairs(const MatrixProducts& A, const LanczosOptions& options) {
  require_lanczos_options(options);
  const Index n = A.rows;
  if (options.rank == 0 || n == 0) return {VectorXd(0), MatrixXd(n, 0)};
  if (options.rank >= n)
    return largest_in_magnitude(symmetric_eigenpairs(A.apply(MatrixXd::Identity(n, n))), n);
  SymmetricEigenpairs pairs = RestartedSearch(A.apply, n, Wanted::largest_magnitude, options).run();
  require_small_residual(A.apply(pairs.vectors) - pairs.vectors * pairs.values.asDiagonal(),
                         pairs.values.cwiseAbs().maxCoeff());
  return pairs;
}

}  // namespace radiosity
