#pragma once

#include "solvers/error_certificate.hpp"

#include <cstdint>
#include <functional>

namespace radiosity {

struct SampledCertificateOptions {
  Index rows = 512;          ///< drawn with replacement; n or more: every row once, and the bound is proved
  double confidence = 0.99;  ///< that all bounds hold together, over the draw (asymptotic in the rows)
  std::uint64_t seed = 1;
};

/// Bounds the error of any B~ as a solution of B = E + T B from some rows of F, where the whole kernel does
/// not fit, or where rows are known better than the F that gave B~ (document: methods.md, "Layers").
///
///   ||B - B~||_A <= ||r||_A / (1 - max_i rho_i),   r = E + T B~ - B~,
///
/// because ||T||_A <= max rho for any reciprocal F whose rows sum to at most 1. ||r||_A^2 = sum_i A_i r_i^2
/// is estimated from the rows drawn, half of them by area and half by the energy that patches reflect, and
/// its upper confidence limit taken: normal, with Johnson's correction for skewness (1978). An error confined
/// to patches that were hardly drawn can escape it: that is the meaning of the confidence. Too large by up to
/// 1 / (1 - rho) where the residual has little uniform light; ErrorCertificate is tighter where the kernel is
/// at hand.
///
/// area: n; reflectance: n x channels; row(i): F_ij for all j, n, called from several threads. Bounds are
/// infinite where some reflectance is 1. Throws UsageError for wrong shapes and options.
ErrorBound sampled_error_bound(const Eigen::VectorXd& area, const Eigen::MatrixXd& reflectance,
                               const std::function<Eigen::VectorXd(Index)>& row, const Field& emission,
                               const Field& radiosity, const SampledCertificateOptions& options = {});

}  // namespace radiosity
