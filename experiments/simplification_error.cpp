#include "experiments/simplification_error.hpp"

#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/irradiance.hpp"
#include "operators/operator_registry.hpp"
#include "scene/light_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiosity {
namespace {

Field irradiance_of(const FormFactors& form_factors, const Field& radiosity) {
  return irradiance(form_factors, *cpu_operators().make("dense:f64", form_factors), radiosity);
}

/// rho H for each light.
Field reflected_light(const PatchMesh& mesh, const Field& irradiance) {
  Field reflected = irradiance;
  for (Index j = 0; j < reflected.cols(); ++j)
    reflected.col(j).array() *= mesh.reflectance.col(j % mesh.channels()).array();
  return reflected;
}

/// E of the quads with the power of E of the original.
Field emission_of_quads(const SimplifiedScene& simplified, const PatchMesh& original, const Field& emission) {
  return simplified.mesh->area.cwiseInverse().asDiagonal() *
         sum_over_fragments(simplified, original, emission);
}

Field mean_on_quads(const SimplifiedScene& simplified, const PatchMesh& original, const Field& field) {
  const Eigen::VectorXd area =
      sum_over_fragments(simplified, original, Field::Ones(original.patch_count(), 1));
  return area.cwiseInverse().asDiagonal() * sum_over_fragments(simplified, original, field);
}

Index light_count(const PatchMesh& mesh, const Field& emission) {
  return std::max<Index>(emission.cols() / mesh.channels(), 1);
}

}  // namespace

std::size_t SimplificationError::factor_bytes() const {
  return static_cast<std::size_t>(patches) * static_cast<std::size_t>(patches) * sizeof(float);
}

Field irradiance_of_lights(const FormFactors& form_factors, const Field& emission) {
  const std::optional<Field> B = reference_solution(form_factors, emission);
  if (!B) fail("no solver gets to a residual of 1e-12 on '{}'", form_factors.mesh->scene->name);
  return irradiance_of(form_factors, *B);
}

IndirectErrors indirect_errors(const PatchMesh& mesh, const Field& indirect, const Field& reference) {
  const std::vector<double> errors = relative_errors(mesh, indirect, reference);
  if (errors.empty() || reference.isZero(0))
    fail("'{}' has no indirect light to compare with", mesh.scene->name);
  return {std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()),
          *std::max_element(errors.begin(), errors.end())};
}

SimplificationError measure_simplification(const FormFactors& form_factors, const Field& emission,
                                           const Field& radiosity, Index wanted,
                                           const FormFactorOptions& options, Monitor& monitor) {
  const PatchMesh& original = *form_factors.mesh;
  const auto lights = static_cast<double>(light_count(original, emission));
  SimplificationError result;
  result.wanted = wanted;
  const Stopwatch simplifying;
  const SimplifiedScene simplified = simplify_to_voxels(original, wanted);
  result.simplify_seconds = simplifying.seconds();
  result.patches = simplified.mesh->patch_count();
  const FormFactors simplified_factors = compute_form_factors(simplified.mesh, options, monitor);
  const FormFactorQuality& quality = simplified_factors.quality;
  result.form_factor_seconds = quality.seconds;
  if (quality.probe_rays > 0) {
    result.leaked = static_cast<double>(quality.leaks) / static_cast<double>(quality.probe_rays);
    result.on_backs = static_cast<double>(quality.back_hits) / static_cast<double>(quality.probe_rays);
  }

  const Field quad_emission = emission_of_quads(simplified, original, emission);
  const Stopwatch solving;
  const Field H = irradiance_of_lights(simplified_factors, quad_emission);
  result.solve_seconds = solving.seconds() / lights;
  const Stopwatch transfer;
  const Field pulled = pull_back_to_patches(simplified, original, H);
  result.transfer_seconds = transfer.seconds() / lights;

  const Field indirect = radiosity - emission;
  result.indirect = indirect_errors(original, reflected_light(original, pulled), indirect);
  const Field averaged = pull_back_to_patches(
      simplified, original, mean_on_quads(simplified, original, irradiance_of(form_factors, radiosity)));
  result.averaged = indirect_errors(original, reflected_light(original, averaged), indirect);
  return result;
}

}  // namespace radiosity
