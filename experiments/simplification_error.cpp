#include "experiments/simplification_error.hpp"

#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/irradiance.hpp"
#include "operators/operator_registry.hpp"
#include "scene/light_transfer.hpp"

namespace radiosity {

Field simplified_irradiance(const FormFactors& form_factors) {
  const std::optional<Field> B = reference_solution(form_factors, form_factors.mesh->emission);
  if (!B) fail("no solver gets to a residual of 1e-12 on '{}'", form_factors.mesh->scene->name);
  return irradiance(form_factors, *cpu_operators().make("dense:f64", form_factors), *B);
}

SimplificationError measure_simplification(const FormFactors& form_factors, const Field& radiosity,
                                           Index wanted, const FormFactorOptions& options, Monitor& monitor) {
  const PatchMesh& original = *form_factors.mesh;
  SimplificationError result;
  result.wanted = wanted;
  const Stopwatch simplifying;
  const SimplifiedScene simplified = simplify_to_voxels(original, wanted);
  result.simplify_seconds = simplifying.seconds();
  result.patches = simplified.mesh->patch_count();
  const FormFactors simplified_factors = compute_form_factors(simplified.mesh, options, monitor);
  result.form_factor_seconds = simplified_factors.quality.seconds;
  const Stopwatch solving;
  const Field H = simplified_irradiance(simplified_factors);
  result.solve_seconds = solving.seconds();
  const Stopwatch transfer;
  const Field B = radiosity_of_patches(simplified, original, H);
  result.transfer_seconds = transfer.seconds();

  const std::vector<double> errors =
      relative_errors(original, B - original.emission, radiosity - original.emission);
  if (errors.empty() || (radiosity - original.emission).isZero(0))
    fail("'{}' has no indirect light to compare with", original.scene->name);
  result.indirect_error = errors.front();
  return result;
}

}  // namespace radiosity
