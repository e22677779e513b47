#include "solvers/spectral_radius.hpp"

#include "factorizations/leading_eigenpairs.hpp"
#include "foundation/error.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/low_rank_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {

namespace {

struct Ratios {
  double low = std::numeric_limits<double>::infinity();
  double high = 0;
  bool negative = false;
};

Ratios entry_ratios(const Field& images, const Field& fields) {
  Ratios ratios;
  for (Index j = 0; j < fields.cols(); ++j) {
    for (Index i = 0; i < fields.rows(); ++i) {
      const double ratio = images(i, j) / fields(i, j);
      ratios.low = std::min(ratios.low, ratio);
      ratios.high = std::max(ratios.high, ratio);
      ratios.negative = ratios.negative || images(i, j) < 0;
    }
  }
  return ratios;
}

/// max |lambda| of R^{1/2} K R^{1/2} over the channels, if the operator is a symmetric kernel.
void bound_by_lanczos(const LinearOperator& transport, SpectralRadius& radius) {
  constexpr double confidence = 0.9999;
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport);
  if (kernel == nullptr || !transport.symmetric()) return;
  double bound = 0;
  for (Index c = 0; c < kernel->channels(); ++c) {
    const Eigen::VectorXd root = kernel->reflectance().col(c).cwiseSqrt();
    const BlockProduct S = [&](const Eigen::MatrixXd& X) {
      Field image(X.rows(), X.cols());
      kernel->apply_kernel(root.asDiagonal() * X, image);
      return Eigen::MatrixXd(root.asDiagonal() * image);
    };
    const EigenvalueInterval interval =
        eigenvalue_interval(S, kernel->size(), confidence, static_cast<std::uint64_t>(c));
    bound = std::max({bound, interval.high, -interval.low});
    radius.products += interval.products;
  }
  if (radius.upper && *radius.upper <= bound) return;
  radius.upper = bound;
  radius.confidence = confidence;
}

}  // namespace

SpectralRadius collatz_wielandt_bounds(const LinearOperator& transport, int max_products) {
  SpectralRadius radius;
  const Certificate certificate = transport.certificate();
  const Index n = transport.size();
  if (n == 0) {
    radius.upper = 0;
    return radius;
  }
  // Low-rank factors are signed even where no product with a positive field shows it.
  const bool is_signed = dynamic_cast<const LowRankFactors*>(&transport) != nullptr;
  const double allowance = 1 + static_cast<double>(n + 2) * std::numeric_limits<double>::epsilon();
  Field fields = Field::Ones(n, transport.channels());
  Field images(n, fields.cols());
  double high = std::numeric_limits<double>::infinity();
  for (int product = 0; product < max_products; ++product) {
    transport.apply(fields, images);
    ++radius.products;
    const Ratios ratios = entry_ratios(images, fields);
    radius.estimate = (images.colwise().norm().array() / fields.colwise().norm().array()).maxCoeff();
    if (is_signed || ratios.negative || !std::isfinite(ratios.high)) {
      radius.lower = 0;
      radius.upper = certificate.spectral_radius_bound;
      return radius;
    }
    const double gain = high - ratios.high;
    high = std::min(high, ratios.high);
    radius.lower = std::max(radius.lower, ratios.low);
    // A convergence rate is known well enough once 1 - radius is known to one part in fifty.
    const double gap = std::max(std::abs(1 - high), 1e-3 * high);
    if (high - radius.lower <= 0.02 * gap || (product > 2 && high < 1 && gain <= 0.002 * gap)) break;
    fields = images + 0.1 * high * fields;
    for (Index j = 0; j < fields.cols(); ++j) {
      const double largest = fields.col(j).maxCoeff();
      if (largest > 0) fields.col(j) /= largest;
    }
  }
  radius.upper = high * allowance;
  if (certificate.spectral_radius_bound)
    radius.upper = std::min(*radius.upper, *certificate.spectral_radius_bound);
  return radius;
}

SpectralRadius bound_spectral_radius(const LinearOperator& transport, int max_products) {
  SpectralRadius radius = collatz_wielandt_bounds(transport, max_products);
  if (!radius.upper || (*radius.upper >= 1 && radius.lower < 1)) bound_by_lanczos(transport, radius);
  return radius;
}

double require_contraction(const std::string& name, const SpectralRadius& radius) {
  if (!radius.upper)
    fail(
        "{}: the operator has negative entries, so that no bound on its spectral radius is known and the "
        "iteration may "
        "diverge: use cg or gmres.",
        name);
  if (*radius.upper >= 1)
    fail(
        "{}: the spectral radius of T is only known to be at most {:.6g}, so that the system may be singular "
        "(a "
        "reflectance of 1 in a closed room) or the iteration diverge (row sums of F above 1): lower the "
        "reflectance "
        "(--max-reflectance), close the form factors, or use cg or gmres.",
        name, *radius.upper);
  return *radius.upper;
}

}  // namespace radiosity
