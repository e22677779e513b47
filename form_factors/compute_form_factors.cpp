#include "form_factors/closure.hpp"
#include "form_factors/exposure.hpp"
#include "form_factors/form_factor_methods.hpp"
#include "form_factors/form_factors.hpp"
#include "form_factors/row_sum_quality.hpp"
#include "foundation/stopwatch.hpp"

#include <cmath>
#include <string>

namespace radiosity {
namespace {

void check(const FormFactorOptions& options) {
  if (!(options.tolerance > 0) || options.tolerance > 0.1)
    fail<UsageError>("form factor tolerance {}: it must be above 0 and at most 0.1", options.tolerance);
  if (options.gather_rays < 16 || options.gather_rays > (1 << 24))
    fail<UsageError>("{} gather rays a patch: between 16 and 16777216 are possible", options.gather_rays);
}

std::string method_name(FormFactorMethod method) {
  switch (method) {
    case FormFactorMethod::one_ray:
      return "one-ray";
    case FormFactorMethod::gather:
      return "gather";
    case FormFactorMethod::accurate:
      break;
  }
  return "accurate";
}

void close_if_wanted(FormFactors& form_factors, SymmetricTiles<double>* kernel, Closure closure) {
  FormFactorQuality& quality = form_factors.quality;
  quality.closure = "none";
  const bool enclosure = form_factors.mesh->topology.enclosure;
  if (closure == Closure::none || (closure == Closure::automatic && !enclosure)) return;
  if (!kernel) {
    quality.closure_note = "gathered factors are not reciprocal and have no symmetric closure";
    return;
  }
  const ClosureResult result = close_symmetric(*kernel, form_factors.mesh->area, form_factors.exposed);
  quality.closure = result.kind;
  quality.closure_note = result.note;
}

}  // namespace

FormFactors compute_form_factors(std::shared_ptr<const PatchMesh> mesh, const FormFactorOptions& options,
                                 Monitor& monitor) {
  check(options);
  const Stopwatch watch;
  FormFactors result;
  result.mesh = mesh;
  const PairExchange exchange(*mesh, options.tolerance, options.seed);
  const Exposure exposure =
      measure_exposure(*mesh, exchange.geometry(), exchange.occluders(), options.seed, monitor);
  result.exposed = exposure.exposed;
  result.quality.method = method_name(options.method);
  result.quality.probe_rays = exposure.probe_rays;
  result.quality.back_hits = exposure.back_hits;
  result.quality.leaks = exposure.leaks;

  std::shared_ptr<SymmetricTiles<double>> kernel;
  if (options.method == FormFactorMethod::gather) {
    GatheredFactors gathered = gather_form_factors(
        *mesh, exchange.geometry(), static_cast<std::uint32_t>(options.gather_rays), options.seed, monitor);
    result.unsymmetric = gathered.factors;
    result.quality.rays = gathered.rays;
  } else {
    AssembledKernel assembled =
        options.method == FormFactorMethod::one_ray
            ? assemble_one_ray(*mesh, exchange.geometry(), exchange.occluders(), monitor)
            : assemble_accurate(*mesh, exchange, monitor);
    kernel = assembled.kernel;
    result.kernel = kernel;
    result.quality.rays = assembled.rays;
    result.group_standard_error = assembled.group_variance.cwiseSqrt();
  }
  close_if_wanted(result, kernel.get(), options.closure);
  measure_row_sums(result);
  result.quality.seconds = watch.seconds();
  result.quality.cpu_seconds = watch.cpu_seconds();
  return result;
}

}  // namespace radiosity
