#include "experiments/certification.hpp"

#include "form_factors/form_factor_rows.hpp"
#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/patch_error_bounds.hpp"
#include "solvers/radau_bound.hpp"
#include "solvers/sampled_certificate.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

/// Below this the truth's own rounding is as large as the error.
constexpr double smallest_known_error = 1e-10;

void take_ratio(CertificateSummary& summary, double ratio) {
  summary.ratio_min = std::min(summary.ratio_min.value_or(ratio), ratio);
  summary.ratio_max = std::max(summary.ratio_max.value_or(ratio), ratio);
}

}  // namespace

Field bound_patch_errors(const FormFactors& form_factors, const Field& emission, const Field& radiosity) {
  if (!form_factors.symmetric())
    fail<UsageError>(
        "error bounds need a symmetric kernel, which form factors by '{}' do not have: use --form-factors "
        "accurate or one-ray",
        form_factors.quality.method);
  const auto transport = cpu_operators().make("dense", form_factors);
  return patch_error_bounds(dynamic_cast<const KernelOperator&>(*transport), emission, radiosity);
}

CertificateSummary certify_from_rows(const std::shared_ptr<const PatchMesh>& mesh, Index rows,
                                     double tolerance, std::uint64_t seed, const Field& emission,
                                     const Field& radiosity) {
  SampledCertificateOptions options;
  options.rows = rows;
  options.seed = seed;
  const FormFactorRows form_factors(mesh, tolerance, seed);
  const ErrorBound bound = sampled_error_bound(
      mesh->area, mesh->reflectance, [&](Index i) { return form_factors.row(i); }, emission, radiosity,
      options);
  CertificateSummary summary;
  const bool all = rows >= mesh->patch_count();
  summary.kind = all ? "proved" : "sampled";
  summary.from_rows = true;
  summary.confidence = all ? 1 : options.confidence;
  summary.products = all ? 1 : static_cast<double>(rows) / static_cast<double>(mesh->patch_count());
  const double largest = bound.relative.size() == 0 ? 0 : bound.relative.maxCoeff();
  if (std::isfinite(largest)) summary.bound = largest;
  return summary;
}

Certifier::Certifier(const FormFactors& form_factors, std::uint64_t seed)
    : transport_(cpu_operators().make("dense", form_factors)), seed_(seed) {}

std::unique_ptr<Certifier> Certifier::make(const FormFactors& form_factors, std::uint64_t seed) {
  if (!form_factors.symmetric()) return nullptr;
  return std::unique_ptr<Certifier>(new Certifier(form_factors, seed));
}

const KernelOperator& Certifier::truth() const {
  return dynamic_cast<const KernelOperator&>(*transport_);
}

ErrorBound Certifier::deflate(const ErrorBound& loose, const Field& emission, const Field& radiosity,
                              CertificateSummary& summary) const {
  if (!deflated_) {
    ErrorCertificateOptions options;
    options.seed = seed_;
    deflated_ = std::make_unique<ErrorCertificate>(truth(), options);
  }
  const Eigen::RowVectorXd absolute = loose.absolute.cwiseMin(deflated_->bound(emission, radiosity).absolute);
  summary.kind = deflated_->kind();
  summary.confidence = deflated_->confidence();
  summary.vectors = deflated_->vectors();
  summary.products += deflated_->products();
  return ErrorBound::of(absolute, truth().root_area(), radiosity, truth().channels());
}

CertificateSummary Certifier::certify(const Field& emission, const Field& radiosity,
                                      const std::optional<Field>& truth_field) const {
  CertificateSummary summary;
  const RadauBound radau = radau_error_bound(truth(), emission, radiosity, {.most_steps = 30});
  summary.kind = "gauss-radau";
  summary.products = radau.products;
  const ErrorBound bound = radau.tight ? radau.bound : deflate(radau.bound, emission, radiosity, summary);
  const double largest = bound.relative.size() == 0 ? 0 : bound.relative.maxCoeff();
  if (std::isfinite(largest)) summary.bound = largest;
  if (!truth_field) return summary;
  const Index channels = truth().channels();
  for (Index light = 0; light < bound.relative.size(); ++light) {
    const auto own = truth_field->middleCols(light * channels, channels);
    const double actual =
        (truth().root_area().asDiagonal() * (radiosity.middleCols(light * channels, channels) - own)).norm();
    const double allowed = bound.absolute.segment(light * channels, channels).norm();
    if (actual > smallest_known_error * (truth().root_area().asDiagonal() * own).norm() &&
        std::isfinite(allowed))
      take_ratio(summary, allowed / actual);
  }
  return summary;
}

}  // namespace radiosity
