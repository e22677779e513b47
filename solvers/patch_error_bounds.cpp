#include "solvers/patch_error_bounds.hpp"

#include "foundation/error.hpp"
#include "solvers/conjugate_gradients.hpp"
#include "solvers/stepped_solver.hpp"

#include <algorithm>

namespace radiosity {

namespace {

/// Smallest factor f >= 1 with (I - T) (f y) >= wanted for all entries, given y's image (I - T) y; none if it
/// is not positive somewhere.
double factor_to_dominate(const Eigen::VectorXd& image, const Eigen::VectorXd& wanted) {
  double factor = 1;
  for (Index i = 0; i < image.size(); ++i) {
    if (!(image[i] > 0)) return 0;
    factor = std::max(factor, wanted[i] / image[i]);
  }
  return factor;
}

}  // namespace

Field patch_error_bounds(const KernelOperator& truth, const Field& emission, const Field& radiosity) {
  const Index n = truth.size();
  if (emission.rows() != n || radiosity.rows() != n || emission.cols() != radiosity.cols() ||
      emission.cols() % truth.channels() != 0)
    fail<UsageError>("error bounds for {} patches and {} channels got E of {} x {} and B of {} x {}", n,
                     truth.channels(), emission.rows(), emission.cols(), radiosity.rows(), radiosity.cols());
  if (n == 0 || emission.cols() == 0) return Field::Zero(emission.rows(), emission.cols());
  // Row sums of T are at most 1 or so, so that the largest entry does for |x|.
  const double product_error = truth.product_error() + 8 * double_roundoff;
  Field gathered(n, radiosity.cols());
  truth.apply(radiosity, gathered);
  Field wanted = (emission + gathered - radiosity).cwiseAbs();
  for (Index j = 0; j < wanted.cols(); ++j) {
    const double rounding =
        2 * product_error * (radiosity.col(j).cwiseAbs().maxCoeff() + emission.col(j).cwiseAbs().maxCoeff());
    // Something on every patch, so that y is positive and the proof covers T itself.
    wanted.col(j).array() += rounding + 1e-3 * wanted.col(j).mean() + 1e-300;
  }
  ConjugateGradients solver({truth, truth.root_area(), {.tolerance = 1e-6}});
  Field bounds = solve(solver, wanted);
  truth.apply(bounds, gathered);
  for (Index j = 0; j < bounds.cols(); ++j) {
    const Eigen::VectorXd image =
        (bounds.col(j) - gathered.col(j)).array() - product_error * bounds.col(j).cwiseAbs().maxCoeff();
    const double factor = bounds.col(j).minCoeff() > 0 ? factor_to_dominate(image, wanted.col(j)) : 0;
    if (factor == 0)
      fail(
          "no bound for single patches was found: the system is too close to a singular one; lower the "
          "reflectance");
    bounds.col(j) *= factor;
  }
  return bounds;
}

}  // namespace radiosity
