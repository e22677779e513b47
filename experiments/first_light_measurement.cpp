#include "experiments/first_light_measurement.hpp"

#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "scene/import.hpp"

namespace radiosity {
namespace {

Field solution_of(const FormFactors& form_factors) {
  const std::optional<Field> B = reference_solution(form_factors, form_factors.mesh->emission);
  if (!B)
    fail("first light found no solution of {} with {} form factors at {} patches",
         form_factors.mesh->scene->name, form_factors.quality.method, form_factors.patch_count());
  return *B;
}

/// Relative error of one light; 0 where the reference is dark.
double error_of(const PatchMesh& mesh, const Field& X, const Field& reference) {
  const std::vector<double> errors = relative_errors(mesh, X, reference);
  return errors.empty() ? 0 : errors.front();
}

FirstLightSize measure_size(Index patches, const FirstLightOptions& options,
                            const OperatorRegistry& operators, const SolverRegistry& solvers,
                            Machine& machine, Monitor& monitor) {
  FirstLightSize size;
  size.mesh = std::make_shared<PatchMesh>(make_patches(open_scene(options.scene), {.patches = patches}));
  const PatchMesh& mesh = *size.mesh;
  size.referee = trace_paths(mesh, {.paths = options.reference_paths, .seed = options.seed}, monitor);

  FormFactorOptions method{.closure = Closure::none, .seed = options.seed};
  size.raw_row_sum_rms = compute_form_factors(size.mesh, method, monitor).quality.row_sum_rms;
  method.closure = Closure::automatic;
  const FormFactors accurate = compute_form_factors(size.mesh, method, monitor);
  size.radiosity = solution_of(accurate);
  size.accurate = {accurate.quality, 0, 0, compare_with_reference(mesh, size.radiosity, size.referee)};

  ComparisonOptions comparison_options;
  comparison_options.operators = options.operators;
  comparison_options.seed = options.seed;
  comparison_options.solver_options.tolerance = options.tolerance;
  Comparison comparison = compare(accurate, operators, solvers, comparison_options, monitor);
  size.operators = std::move(comparison.results);
  machine = comparison.machine;

  // 003's method as it was written: no closure.
  method.method = FormFactorMethod::one_ray;
  method.closure = Closure::none;
  const FormFactors one_ray = compute_form_factors(size.mesh, method, monitor);
  const Field B = solution_of(one_ray);
  size.one_ray = {one_ray.quality, error_of(mesh, B, size.radiosity),
                  error_of(mesh, B - mesh.emission, size.radiosity - mesh.emission),
                  compare_with_reference(mesh, B, size.referee)};
  return size;
}

}  // namespace

FirstLightMeasurement measure_first_light(const FirstLightOptions& options, const OperatorRegistry& operators,
                                          const SolverRegistry& solvers, Monitor& monitor) {
  if (options.patches.empty()) fail<UsageError>("first light needs at least one number of patches");
  FirstLightMeasurement measurement;
  measurement.tolerance = options.tolerance;
  for (const Index patches : options.patches)
    measurement.sizes.push_back(
        measure_size(patches, options, operators, solvers, measurement.machine, monitor));
  return measurement;
}

}  // namespace radiosity
