#include "solvers/radau_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace radiosity {
namespace {

/// Solves a symmetric tridiagonal system with `diagonal` and `beside` (one shorter); empty unless it is
/// positive definite.
std::optional<std::vector<double>> solve_tridiagonal(std::vector<double> diagonal,
                                                     const std::vector<double>& beside,
                                                     std::vector<double> right) {
  const std::size_t n = diagonal.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) {
      const double factor = beside[k - 1] / diagonal[k - 1];
      diagonal[k] -= factor * beside[k - 1];
      right[k] -= factor * right[k - 1];
    }
    if (!(diagonal[k] > 0)) return std::nullopt;
  }
  for (std::size_t k = n; k-- > 0;) {
    if (k + 1 < n) right[k] -= beside[k] * right[k + 1];
    right[k] /= diagonal[k];
  }
  return right;
}

/// ||T^-1 e1||, empty unless T is positive definite.
std::optional<double> norm_of_first_column(const std::vector<double>& diagonal,
                                           const std::vector<double>& beside) {
  std::vector<double> unit(diagonal.size(), 0.0);
  unit.front() = 1;
  const auto solution = solve_tridiagonal(diagonal, beside, std::move(unit));
  if (!solution) return std::nullopt;
  double square = 0;
  for (const double x : *solution) square += x * x;
  return std::sqrt(square);
}

/// Lanczos from one residual with I - S, and what it says of ||(I - S)^-1 r||.
class LanczosColumn {
 public:
  LanczosColumn(const Eigen::VectorXd& residual, double mu, int most_steps)
      : norm_(residual.norm()), mu_(mu) {
    basis_.resize(residual.size(), std::min<Index>(most_steps + 1, residual.size() + 1));
    if (norm_ > 0) basis_.col(0) = residual / norm_;
    open_ = norm_ > 0;
    upper_ = norm_ / mu;
  }

  bool open() const { return open_; }
  Index steps() const { return static_cast<Index>(diagonal_.size()); }
  Eigen::VectorXd direction() const { return basis_.col(steps()); }
  double upper() const { return upper_; }
  double ratio() const { return norm_ == 0 ? 1 : upper_ / lower_; }

  /// image = (I - S) direction().
  void take(Eigen::VectorXd image, double wanted_ratio) {
    const Index k = steps();
    diagonal_.push_back(image.dot(basis_.col(k)));
    for (int pass = 0; pass < 2; ++pass)  // twice is enough
      image -= basis_.leftCols(k + 1) * (basis_.leftCols(k + 1).transpose() * image);
    const double next = image.norm();
    const bool exhausted = !(next > 1e-14) || k + 2 > basis_.cols();
    update_bounds(exhausted && !(next > 1e-14) ? 0 : next);
    if (exhausted || ratio() <= wanted_ratio) {
      open_ = false;
      return;
    }
    beside_.push_back(next);
    basis_.col(k + 1) = image / next;
  }

 private:
  void update_bounds(double next) {
    const auto gauss = norm_of_first_column(diagonal_, beside_);
    if (!gauss) return;
    lower_ = norm_ * *gauss;
    if (next == 0) {  // the space is exhausted: Gauss's rule is exact
      upper_ = lower_;
      return;
    }
    // Radau: an eigenvalue at mu for the matrix extended by one row.
    std::vector<double> shifted = diagonal_;
    for (double& entry : shifted) entry -= mu_;
    std::vector<double> right(shifted.size(), 0.0);
    right.back() = next * next;
    const auto delta = solve_tridiagonal(std::move(shifted), beside_, std::move(right));
    if (!delta) return;
    std::vector<double> diagonal = diagonal_;
    std::vector<double> beside = beside_;
    diagonal.push_back(mu_ + delta->back());
    beside.push_back(next);
    if (const auto radau = norm_of_first_column(diagonal, beside)) upper_ = std::min(upper_, norm_ * *radau);
  }

  double norm_;
  double mu_;
  double upper_ = 0;
  double lower_ = 0;
  bool open_ = false;
  Eigen::MatrixXd basis_;
  std::vector<double> diagonal_;
  std::vector<double> beside_;
};

/// One step of every open column, all in one product.
void advance(const KernelOperator& truth, const Field& root, std::vector<LanczosColumn>& columns,
             const std::vector<Index>& open, double wanted_ratio) {
  const Index channels = truth.channels();
  Field inputs(truth.size(), static_cast<Index>(open.size()));
  Field outputs(inputs.rows(), inputs.cols());
  for (Index k = 0; k < inputs.cols(); ++k) {
    const Index j = open[static_cast<std::size_t>(k)];
    inputs.col(k) = root.col(j % channels).cwiseProduct(columns[static_cast<std::size_t>(j)].direction());
  }
  truth.apply_kernel(inputs, outputs);
  for (Index k = 0; k < inputs.cols(); ++k) {
    const Index j = open[static_cast<std::size_t>(k)];
    LanczosColumn& column = columns[static_cast<std::size_t>(j)];
    column.take(column.direction() - root.col(j % channels).cwiseProduct(outputs.col(k)), wanted_ratio);
  }
}

}  // namespace

RadauBound radau_error_bound(const KernelOperator& truth, const Field& emission, const Field& radiosity,
                             const RadauBoundOptions& options) {
  constexpr double slack = 1 + 1e-6;  // for the rounding of the Lanczos steps
  const Index channels = truth.channels();
  const WeightedResidual start = weighted_residual(truth, emission, radiosity);
  Index multiplied = start.columns + 1;
  const Eigen::RowVectorXd rows = largest_rows(truth);
  const Field root = truth.reflectance().cwiseSqrt();

  std::vector<LanczosColumn> columns;
  for (Index j = 0; j < radiosity.cols(); ++j)
    columns.emplace_back(start.residual.col(j), std::max(1 - rows[j % channels], 0.0), options.most_steps);
  for (int step = 0; step < options.most_steps; ++step) {
    std::vector<Index> open;
    for (Index j = 0; j < radiosity.cols(); ++j)
      if (columns[static_cast<std::size_t>(j)].open() && rows[j % channels] < 1) open.push_back(j);
    if (open.empty()) break;
    advance(truth, root, columns, open, options.wanted_ratio);
    multiplied += static_cast<Index>(open.size());
  }

  RadauBound result;
  Eigen::RowVectorXd absolute(radiosity.cols());
  for (Index j = 0; j < radiosity.cols(); ++j) {
    const LanczosColumn& column = columns[static_cast<std::size_t>(j)];
    const double mu = 1 - rows[j % channels];
    const double root_max = truth.size() == 0 ? 0 : root.col(j % channels).maxCoeff();
    absolute[j] = mu > 0 ? root_max * (slack * column.upper() + start.rounding[j] / mu) + start.moved[j]
                         : std::numeric_limits<double>::infinity();
    result.tight = result.tight && mu > 0 && column.ratio() <= options.wanted_ratio;
  }
  result.bound = ErrorBound::of(absolute, truth.root_area(), radiosity, channels);
  result.products = static_cast<double>(multiplied) / static_cast<double>(channels);
  return result;
}

}  // namespace radiosity
