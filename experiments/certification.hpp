#pragma once

#include "form_factors/form_factors.hpp"
#include "solvers/error_certificate.hpp"

#include <memory>
#include <optional>
#include <string>

namespace radiosity {

/// What a certificate says of a set of answers (key "certificate" of the JSON).
struct CertificateSummary {
  std::optional<double> bound;  ///< largest ||B - B~||_A / ||B||_A over the lights; empty: not bounded
  std::string kind;             ///< proved, deflated, gauss-radau or sampled
  double confidence = 1;
  bool from_rows = false;           ///< certify_from_rows: against F computed afresh
  Index vectors = 0;                ///< deflated, over all channels
  double products = 0;              ///< with the true kernel, for all answers
  std::optional<double> ratio_min;  ///< of bound / actual error over the lights, where the truth is known
  std::optional<double> ratio_max;
};

/// |B_ij - B~_ij| <= the result, n x c, with the true kernel (solvers/patch_error_bounds.hpp). Throws
/// UsageError where form factors have no symmetric kernel.
Field bound_patch_errors(const FormFactors& form_factors, const Field& emission, const Field& radiosity);

/// Certifies an answer against `rows` rows of F that are computed afresh by the accurate method, with a
/// tolerance and a seed of their own (solvers/sampled_certificate.hpp): for kernels that do not fit, and for
/// form factors that are not trusted. kind is "sampled", or "proved" with rows >= n; products counts rows /
/// n.
CertificateSummary certify_from_rows(const std::shared_ptr<const PatchMesh>& mesh, Index rows,
                                     double tolerance, std::uint64_t seed, const Field& emission,
                                     const Field& radiosity);

/// Certifies answers against assembled form factors; null where these have no symmetric kernel. Gauss-Radau
/// quadrature proves most bounds in a few products (solvers/radau_bound.hpp); where it stays loose,
/// eigenvectors are found, once (solvers/error_certificate.hpp), and the smaller bound counts.
class Certifier {
 public:
  static std::unique_ptr<Certifier> make(const FormFactors& form_factors, std::uint64_t seed);

  /// `truth`, if it is known, is an answer whose own error does not matter: it only serves the ratios.
  CertificateSummary certify(const Field& emission, const Field& radiosity,
                             const std::optional<Field>& truth = std::nullopt) const;

 private:
  Certifier(const FormFactors& form_factors, std::uint64_t seed);

  const KernelOperator& truth() const;
  /// Replaces the bounds that are not tight by those of eigenvectors.
  ErrorBound deflate(const ErrorBound& loose, const Field& emission, const Field& radiosity,
                     CertificateSummary& summary) const;

  std::unique_ptr<LinearOperator> transport_;
  std::uint64_t seed_;
  mutable std::unique_ptr<ErrorCertificate> deflated_;  ///< once it is needed
};

}  // namespace radiosity
