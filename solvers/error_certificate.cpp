#include "solvers/error_certificate.hpp"

#include "factorizations/leading_eigenpairs.hpp"
#include "foundation/error.hpp"
#include "solvers/stepped_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double black = 1e-4;  // reflectances below this are not divided by

/// Bound on the largest eigenvalue of a non-negative T = R F over the rows: max rho_i sum_j F_ij.
double largest_row(const Eigen::VectorXd& reflectance, const Eigen::VectorXd& row_sums) {
  if (reflectance.size() == 0) return 0;
  const double allowance = 1 + 4 * static_cast<double>(reflectance.size() + 2) * unit_roundoff;
  return reflectance.cwiseProduct(row_sums).maxCoeff() * allowance;
}

}  // namespace

ErrorCertificate::ErrorCertificate(const KernelOperator& truth, const ErrorCertificateOptions& options)
    : truth_(truth) {
  Field sums(truth.size(), 1);
  if (truth.size() > 0) truth.apply_kernel(truth.root_area(), sums);
  count_columns(1);
  const Eigen::VectorXd row_sums = sums.col(0).cwiseQuotient(truth.root_area());
  for (Index c = 0; c < truth.channels(); ++c) channels_.push_back(examine_channel(c, row_sums, options));
}

Index ErrorCertificate::vectors() const {
  Index count = 0;
  for (const Channel& channel : channels_) count += channel.values.size();
  return count;
}

ErrorCertificate::Channel ErrorCertificate::examine_channel(Index channel, const Eigen::VectorXd& row_sums,
                                                            const ErrorCertificateOptions& options) {
  Channel result;
  const Eigen::VectorXd reflectance = truth_.reflectance().col(channel);
  result.root = reflectance.cwiseSqrt();
  result.row_bound = largest_row(reflectance, row_sums);
  result.rest = result.row_bound;
  result.vectors.resize(truth_.size(), 0);
  if (1 + result.row_bound <= options.wanted_ratio * (1 - result.row_bound)) return result;

  EigenpairOptions search;
  search.wanted_ratio = options.wanted_ratio;
  search.lowest = -result.row_bound;
  search.accuracy = 0.02 * std::sqrt(std::max(1 - result.row_bound, 1e-8) / options.wanted_ratio);
  search.most = options.most_vectors;
  search.confidence = options.confidence;
  search.seed = options.seed + static_cast<std::uint64_t>(channel);
  const BlockProduct S = [&](const Eigen::MatrixXd& X) {
    Field image(X.rows(), X.cols());
    truth_.apply_kernel(result.root.asDiagonal() * X, image);
    return Eigen::MatrixXd(result.root.asDiagonal() * image);
  };
  LeadingEigenpairs pairs = leading_eigenpairs(S, truth_.size(), search);
  count_columns(pairs.products);
  result.values = std::move(pairs.values);
  result.vectors = std::move(pairs.vectors);
  result.eta = pairs.residual;
  result.rest = std::min(result.row_bound, pairs.rest_bound);
  kind_ = "deflated";
  confidence_ = std::min(confidence_, options.confidence);
  return result;
}

/// ||R^{1/2} (w - w~)|| from r = (I - S)(w - w~), known to within `rounding`. With w - w~ = V a + z, V'z = 0:
///   (1 - theta_i) a_i = c_i + (E'z)_i and (I - Q S Q) z = Q r + E a, where c = V'r and E = S V - V Theta, so
///   |z| <= (|Q r| + eta |a0|) / (1 - mu - eta^2 / (1 - theta_1)), a0_i = c_i / (1 - theta_i),
///   |a - a0| <= eta |z| / (1 - theta_1).
double ErrorCertificate::bound_column(const Channel& channel, const Eigen::VectorXd& residual,
                                      double rounding) const {
  const double root_max = channel.root.size() == 0 ? 0 : channel.root.maxCoeff();
  if (channel.values.size() == 0) {
    if (channel.rest >= 1) return infinite;
    return root_max * (residual.norm() + rounding) / (1 - channel.rest);
  }
  const double gap = 1 - channel.values.maxCoeff();
  if (!(gap > 0)) return infinite;
  const double rest_gap = 1 - channel.rest - channel.eta * channel.eta / gap;
  if (!(rest_gap > 0)) return infinite;
  const Eigen::VectorXd along = channel.vectors.transpose() * residual;
  const double across = (residual - channel.vectors * along).norm() + rounding;
  const Eigen::VectorXd amplified = along.array() / (1 - channel.values.array());
  const double z = (across + channel.eta * (amplified.norm() + rounding / gap)) / rest_gap;
  const double uncertain = (channel.eta * z + rounding) / gap;
  const double as_triangle =
      channel.root.cwiseProduct(channel.vectors * amplified).norm() + root_max * (uncertain + z);
  const double as_square = root_max * std::hypot(amplified.norm() + uncertain, z);
  return std::min(as_triangle, as_square);
}

ErrorBound ErrorCertificate::bound(const Field& emission, const Field& radiosity) const {
  const Index n = truth_.size(), channels = truth_.channels();
  if (emission.rows() != n || radiosity.rows() != n || emission.cols() != radiosity.cols() ||
      emission.cols() % channels != 0)
    fail<UsageError>("a certificate for {} patches and {} channels got E of {} x {} and B of {} x {}", n,
                     channels, emission.rows(), emission.cols(), radiosity.rows(), radiosity.cols());
  const Field energy = truth_.root_area().asDiagonal() * radiosity;  // b~
  const Field light = truth_.root_area().asDiagonal() * emission;    // e
  Field gathered(n, radiosity.cols());
  truth_.apply_kernel(energy, gathered);  // K b~
  count_columns(radiosity.cols());

  // Where a patch is (nearly) black, w~ cannot be had from b~ - e: one bounce of b~ takes the place of b~
  // there.
  Field bounced = energy;
  Eigen::RowVectorXd moved = Eigen::RowVectorXd::Zero(radiosity.cols());
  for (Index j = 0; j < radiosity.cols(); ++j) {
    const Eigen::VectorXd& root = channels_[static_cast<std::size_t>(j % channels)].root;
    for (Index i = 0; i < n; ++i)
      if (root[i] * root[i] < black) bounced(i, j) = light(i, j) + root[i] * root[i] * gathered(i, j);
    moved[j] = (bounced.col(j) - energy.col(j)).norm();
  }
  if (moved.maxCoeff() > 0) {
    truth_.apply_kernel(bounced, gathered);
    count_columns(radiosity.cols());
  }

  ErrorBound result;
  result.absolute.resize(radiosity.cols());
  const double product_error = 2 * static_cast<double>(n + 8) * unit_roundoff;
  for (Index j = 0; j < radiosity.cols(); ++j) {
    const Channel& channel = channels_[static_cast<std::size_t>(j % channels)];
    Eigen::VectorXd residual(n);
    for (Index i = 0; i < n; ++i) {
      const double rho = channel.root[i] * channel.root[i];
      // For a black patch, w~ is one more bounce, of `bounced`, and its residual is 0.
      residual[i] = rho < black
                        ? 0
                        : channel.root[i] * gathered(i, j) - (bounced(i, j) - light(i, j)) / channel.root[i];
    }
    const double rounding = product_error * (bounced.col(j).norm() + residual.norm());
    result.absolute[j] = bound_column(channel, residual, rounding) + moved[j];
  }
  result.relative.resize(radiosity.cols() / channels);
  for (Index light_index = 0; light_index < result.relative.size(); ++light_index) {
    const double error = result.absolute.segment(light_index * channels, channels).norm();
    const double norm = energy.middleCols(light_index * channels, channels).norm();
    result.relative[light_index] = error == 0 ? 0 : (error < norm ? error / (norm - error) : infinite);
  }
  return result;
}

}  // namespace radiosity
