#include "solvers/sampled_certificate.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "solvers/stepped_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace radiosity {
namespace {

/// How likely each patch is drawn: half by area, half by the energy that leaves it indirectly.
Eigen::VectorXd draw_probabilities(const Eigen::VectorXd& area, const Field& emission,
                                   const Field& radiosity) {
  const Eigen::VectorXd energy = area.cwiseProduct((radiosity - emission).rowwise().squaredNorm());
  const Eigen::VectorXd by_area = area / area.sum();
  return energy.sum() > 0 ? Eigen::VectorXd(0.5 * by_area + 0.5 * energy / energy.sum()) : by_area;
}

/// Patches drawn, and how often each.
struct Draw {
  std::vector<Index> patches;
  std::vector<double> times;
};

Draw draw_patches(const Eigen::VectorXd& probability, Index rows, std::uint64_t seed) {
  std::vector<double> limits(static_cast<std::size_t>(probability.size()));
  std::partial_sum(probability.begin(), probability.end(), limits.begin());
  std::vector<double> counts(limits.size(), 0.0);
  RandomStream random(seed, 77);
  for (Index k = 0; k < rows; ++k) {
    // Stratified: one in each of `rows` equal parts.
    const double at = (static_cast<double>(k) + random.uniform()) / static_cast<double>(rows) * limits.back();
    const auto found = std::min(std::upper_bound(limits.begin(), limits.end(), at), limits.end() - 1);
    counts[static_cast<std::size_t>(found - limits.begin())] += 1;
  }
  Draw draw;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) {
      draw.patches.push_back(static_cast<Index>(i));
      draw.times.push_back(counts[i]);
    }
  return draw;
}

/// |r_i| for the patches drawn, patches x c, with the rounding of its own computation added.
Field residual_rows(const std::vector<Index>& patches, const Eigen::MatrixXd& reflectance,
                    const std::function<Eigen::VectorXd(Index)>& row, const Field& emission,
                    const Field& radiosity) {
  const Index n = reflectance.rows();
  const double rounding = 2 * static_cast<double>(n + 8) * double_roundoff;
  Field residual(static_cast<Index>(patches.size()), emission.cols());
  parallel_for(patches.size(), [&](std::size_t k) {
    const Index i = patches[k];
    const Eigen::VectorXd factors = row(i);
    if (factors.size() != n)
      fail<UsageError>("row {} of F has {} entries for {} patches", i, factors.size(), n);
    for (Index j = 0; j < emission.cols(); ++j) {
      const double rho = reflectance(i, j % reflectance.cols());
      const double gathered = rho * factors.dot(radiosity.col(j));
      residual(static_cast<Index>(k), j) =
          std::fabs(emission(i, j) + gathered - radiosity(i, j)) +
          rounding * (rho * factors.dot(radiosity.col(j).cwiseAbs()) + std::fabs(radiosity(i, j)));
    }
  });
  return residual;
}

/// z with P(N(0, 1) > z) = tail.
double normal_quantile(double tail) {
  double low = -40, high = 40;
  for (int step = 0; step < 100; ++step) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(z / std::sqrt(2.0)) > tail ? low : high) = z;
  }
  return high;
}

/// Upper confidence limit of the mean of `values`, each counted so many times.
double upper_limit_of_mean(const Eigen::VectorXd& values, const std::vector<double>& times, double tail) {
  const Eigen::Map<const Eigen::VectorXd> weight(times.data(), static_cast<Index>(times.size()));
  const double count = weight.sum();
  const double mean = weight.dot(values) / count;
  const Eigen::ArrayXd centred = values.array() - mean;
  const double variance = (weight.array() * centred.square()).sum() / std::max(1.0, count - 1);
  if (variance == 0) return mean;
  const double third = (weight.array() * centred.cube()).sum() / count;
  const double z = normal_quantile(tail);
  const double skewness = std::max(0.0, third / (6 * variance * count) * (1 + 2 * z * z));
  return mean + z * std::sqrt(variance / count) + skewness;
}

void check(const Eigen::VectorXd& area, const Eigen::MatrixXd& reflectance, const Field& emission,
           const Field& radiosity, const SampledCertificateOptions& options) {
  const Index n = area.size(), channels = reflectance.cols();
  if (reflectance.rows() != n || emission.rows() != n || radiosity.rows() != n || channels == 0 ||
      emission.cols() != radiosity.cols() || emission.cols() % channels != 0)
    fail<UsageError>("a sampled certificate for {} patches and {} channels got E of {} x {} and B of {} x {}",
                     n, channels, emission.rows(), emission.cols(), radiosity.rows(), radiosity.cols());
  if (options.rows < 32) fail<UsageError>("a certificate from {} rows: choose at least 32", options.rows);
  if (!(options.confidence > 0 && options.confidence < 1))
    fail<UsageError>("a confidence of {}: choose one between 0 and 1", options.confidence);
}

}  // namespace

ErrorBound sampled_error_bound(const Eigen::VectorXd& area, const Eigen::MatrixXd& reflectance,
                               const std::function<Eigen::VectorXd(Index)>& row, const Field& emission,
                               const Field& radiosity, const SampledCertificateOptions& options) {
  check(area, reflectance, emission, radiosity, options);
  const Index n = area.size(), channels = reflectance.cols(), columns = emission.cols();
  ErrorBound bound;
  bound.absolute = Eigen::RowVectorXd::Zero(columns);
  bound.relative = Eigen::RowVectorXd::Zero(columns / channels);
  if (n == 0 || columns == 0) return bound;

  const bool all_rows = options.rows >= n;
  Eigen::VectorXd probability = draw_probabilities(area, emission, radiosity);
  Draw draw;
  if (all_rows) {
    draw.patches.resize(static_cast<std::size_t>(n));
    std::iota(draw.patches.begin(), draw.patches.end(), 0);
  } else {
    draw = draw_patches(probability, options.rows, options.seed);
  }
  const Field residual = residual_rows(draw.patches, reflectance, row, emission, radiosity);
  const double tail = (1 - options.confidence) / static_cast<double>(columns);
  for (Index j = 0; j < columns; ++j) {
    const double largest = reflectance.col(j % channels).maxCoeff();
    Eigen::VectorXd energy(residual.rows());  // A_i r_i^2
    for (Index k = 0; k < energy.size(); ++k)
      energy[k] = area[draw.patches[static_cast<std::size_t>(k)]] * residual(k, j) * residual(k, j);
    double square = energy.sum();
    if (!all_rows) {
      for (Index k = 0; k < energy.size(); ++k)
        energy[k] /= probability[draw.patches[static_cast<std::size_t>(k)]];
      square = upper_limit_of_mean(energy, draw.times, tail);
    }
    bound.absolute[j] =
        largest < 1 ? std::sqrt(square) / (1 - largest) : std::numeric_limits<double>::infinity();
  }
  return ErrorBound::of(bound.absolute, area.cwiseSqrt(), radiosity, channels);
}

}  // namespace radiosity
