#include "factorizations/symmetric_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {
namespace {

constexpr int most_sweeps = 200;
constexpr double exact = 1e-13;  // but going on is cheap
constexpr double largest_factor = 2;

/// Largest difference of d_i reached_i from target_i; 1 where a row cannot reach its target.
double scaling_deviation(const Eigen::VectorXd& d, const Eigen::VectorXd& reached,
                         const Eigen::VectorXd& target) {
  double deviation = 0;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    if (target[i] <= 0) continue;
    if (!(reached[i] > 0)) return 1;
    deviation = std::max(deviation, std::abs(d[i] * reached[i] - target[i]));
  }
  return deviation;
}

void sinkhorn_sweep(Eigen::VectorXd& d, const Eigen::VectorXd& reached, const Eigen::VectorXd& target) {
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (target[i] > 0) d[i] = std::sqrt(d[i] * target[i] / reached[i]);
}

Eigen::VectorXd energy_removing_factors(const Eigen::VectorXd& sums, const Eigen::VectorXd& target) {
  Eigen::VectorXd d = Eigen::VectorXd::Ones(sums.size());
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (target[i] > 0 && sums[i] > target[i]) d[i] = target[i] / sums[i];
  return d;
}

}  // namespace

SymmetricScaling scale_symmetric(const VectorProduct& K, const Eigen::VectorXd& weights,
                                 const Eigen::VectorXd& target, double tolerance) {
  SymmetricScaling result;
  Eigen::VectorXd d = Eigen::VectorXd::Ones(weights.size());
  Eigen::VectorXd first_sums;
  double deviation = 0, best = std::numeric_limits<double>::infinity();
  int without_gain = 0;
  for (; result.sweeps < most_sweeps; ++result.sweeps) {
    const Eigen::VectorXd reached = K(d.cwiseProduct(weights)).cwiseQuotient(weights);
    if (result.sweeps == 0) first_sums = reached;
    deviation = scaling_deviation(d, reached, target);
    if (deviation == 1 || deviation <= exact) break;
    without_gain = deviation < 0.99 * best ? 0 : without_gain + 1;
    best = std::min(best, deviation);
    if (best <= tolerance && without_gain > 5) break;  // rounding is reached
    sinkhorn_sweep(d, reached, target);
  }
  result.exists = d.size() == 0 || (deviation <= tolerance && d.minCoeff() >= 1 / largest_factor &&
                                    d.maxCoeff() <= largest_factor);
  if (!result.exists) {
    result.note = fmt::format(
        "no symmetric scaling reaches the wanted row sums (deviation {:.1e} after {} sweeps, factors {:.2g} "
        "to {:.2g}); rows were only scaled down",
        deviation, result.sweeps, d.minCoeff(), d.maxCoeff());
    d = energy_removing_factors(first_sums, target);
  }
  result.factors = std::move(d);
  return result;
}

}  // namespace radiosity
