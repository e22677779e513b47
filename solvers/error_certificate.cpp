#include "solvers/error_certificate.hpp"

#include "factorizations/leading_eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
}  // namespace

ErrorCertificate::ErrorCertificate(const KernelOperator& truth, const ErrorCertificateOptions& options)
    : truth_(truth) {
  const Eigen::RowVectorXd rows = largest_rows(truth);
  count_columns(1);
  for (Index c = 0; c < truth.channels(); ++c) channels_.push_back(examine_channel(c, rows[c], options));
}

Index ErrorCertificate::vectors() const {
  Index count = 0;
  for (const Channel& channel : channels_) count += channel.values.size();
  return count;
}

ErrorCertificate::Channel ErrorCertificate::examine_channel(Index channel, double row_bound,
                                                            const ErrorCertificateOptions& options) {
  Channel result;
  result.root = truth_.reflectance().col(channel).cwiseSqrt();
  result.row_bound = row_bound;
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
  const WeightedResidual start = weighted_residual(truth_, emission, radiosity);
  count_columns(start.columns);
  Eigen::RowVectorXd absolute(radiosity.cols());
  for (Index j = 0; j < radiosity.cols(); ++j) {
    const Channel& channel = channels_[static_cast<std::size_t>(j % truth_.channels())];
    absolute[j] = bound_column(channel, start.residual.col(j), start.rounding[j]) + start.moved[j];
  }
  return ErrorBound::of(absolute, truth_.root_area(), radiosity, truth_.channels());
}

}  // namespace radiosity
