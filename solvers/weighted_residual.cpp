#include "solvers/weighted_residual.hpp"

#include "foundation/error.hpp"
#include "solvers/stepped_solver.hpp"

#include <limits>

namespace radiosity {
namespace {

constexpr double black = 1e-4;  // reflectances below this are not divided by

}  // namespace

WeightedResidual weighted_residual(const KernelOperator& truth, const Field& emission,
                                   const Field& radiosity) {
  const Index n = truth.size(), channels = truth.channels();
  if (emission.rows() != n || radiosity.rows() != n || emission.cols() != radiosity.cols() ||
      emission.cols() % channels != 0)
    fail<UsageError>("a certificate for {} patches and {} channels got E of {} x {} and B of {} x {}", n,
                     channels, emission.rows(), emission.cols(), radiosity.rows(), radiosity.cols());
  const Field root = truth.reflectance().cwiseSqrt();
  const Field energy = truth.root_area().asDiagonal() * radiosity;  // b~
  const Field light = truth.root_area().asDiagonal() * emission;    // e
  Field gathered(n, radiosity.cols());
  truth.apply_kernel(energy, gathered);  // K b~

  WeightedResidual result;
  result.columns = radiosity.cols();
  // Where a patch is (nearly) black, w~ cannot be had from b~ - e: one bounce of b~ takes the place of b~
  // there.
  Field bounced = energy;
  result.moved = Eigen::RowVectorXd::Zero(radiosity.cols());
  for (Index j = 0; j < radiosity.cols(); ++j) {
    for (Index i = 0; i < n; ++i) {
      const double rho = truth.reflectance()(i, j % channels);
      if (rho < black) bounced(i, j) = light(i, j) + rho * gathered(i, j);
    }
    result.moved[j] = (bounced.col(j) - energy.col(j)).norm();
  }
  if (result.moved.size() > 0 && result.moved.maxCoeff() > 0) {
    truth.apply_kernel(bounced, gathered);
    result.columns += radiosity.cols();
  }

  result.residual.resize(n, radiosity.cols());
  result.rounding.resize(radiosity.cols());
  const double product_error = truth.product_error() + 8 * double_roundoff;  // the diagonals' in it
  for (Index j = 0; j < radiosity.cols(); ++j) {
    for (Index i = 0; i < n; ++i) {
      const double own = root(i, j % channels);
      // For a black patch, w~ is one more bounce, of `bounced`, and its residual is 0.
      result.residual(i, j) =
          own * own < black ? 0 : own * gathered(i, j) - (bounced(i, j) - light(i, j)) / own;
    }
    result.rounding[j] = product_error * (bounced.col(j).norm() + result.residual.col(j).norm());
  }
  return result;
}

ErrorBound ErrorBound::of(const Eigen::RowVectorXd& absolute, const Eigen::VectorXd& root_area,
                          const Field& radiosity, Index channels) {
  ErrorBound bound{absolute, Eigen::RowVectorXd(absolute.size() / channels)};
  for (Index light = 0; light < bound.relative.size(); ++light) {
    const double error = absolute.segment(light * channels, channels).norm();
    const double norm = (root_area.asDiagonal() * radiosity.middleCols(light * channels, channels)).norm();
    bound.relative[light] =
        error == 0 ? 0 : (error < norm ? error / (norm - error) : std::numeric_limits<double>::infinity());
  }
  return bound;
}

Eigen::RowVectorXd largest_rows(const KernelOperator& truth) {
  Field sums = Field::Zero(truth.size(), 1);
  if (truth.size() == 0) return Eigen::RowVectorXd::Zero(truth.channels());
  truth.apply_kernel(truth.root_area(), sums);
  const Eigen::ArrayXd rows = sums.col(0).cwiseQuotient(truth.root_area()).array();
  const double allowance = 1 + 4 * static_cast<double>(truth.size() + 2) * double_roundoff;
  return (truth.reflectance().array().colwise() * rows).colwise().maxCoeff() * allowance;
}

}  // namespace radiosity
