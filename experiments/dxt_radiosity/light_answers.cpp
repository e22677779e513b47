#include "experiments/dxt_radiosity/light_answers.hpp"

#include "experiments/operator_measures.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"

#include <memory>
#include <numeric>
#include <utility>

namespace radiosity {
namespace {

double mean_over_lights(const std::vector<double>& errors) {
  if (errors.empty()) return 0;
  return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

}  // namespace

AnswerErrors answer_errors(const PatchMesh& mesh, const Field& emission, const Field& radiosity,
                           const Field& reference) {
  return {mean_over_lights(relative_errors(mesh, radiosity, reference)),
          mean_over_lights(relative_errors(mesh, Field(radiosity - emission), Field(reference - emission)))};
}

LitScene lit_scene(FormFactors form_factors, const LightCounts& lights, std::uint64_t seed,
                   Monitor& monitor) {
  Field emission = draw_lights(*form_factors.mesh, lights, seed, monitor).emission;
  std::optional<Field> reference = reference_solution(form_factors, emission);
  if (!reference) fail("no solver finds the radiosity of the scene to compare with");
  return {std::move(form_factors), std::move(emission), std::move(*reference)};
}

FormFactors with_even_reflectance(const FormFactors& form_factors, double reflectance) {
  auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
  mesh->reflectance.setConstant(reflectance);
  FormFactors changed = form_factors;
  changed.mesh = std::move(mesh);
  return changed;
}

Field after_bounces(const LinearOperator& transport, const Field& emission, long bounces) {
  Field radiosity = emission;
  Field reflected(emission.rows(), emission.cols());
  for (long bounce = 0; bounce < bounces; ++bounce) {
    transport.apply(radiosity, reflected);
    radiosity = emission + reflected;
  }
  return radiosity;
}

OperatorAnswer operator_answer(const std::string& spec, const LitScene& scene, bool with_operator_error,
                               const OperatorRegistry& operators, const SolverRegistry& solvers,
                               Monitor& monitor) {
  monitor.checkpoint("answer of " + spec, 0);
  const auto transport = operators.make(spec, scene.form_factors);
  OperatorAnswer answer{spec, transport->bytes().total(), {}, {}, {}};
  if (with_operator_error && !transport->global())
    answer.operator_error = relative_frobenius_error(*transport, scene.form_factors, monitor);
  try {
    const auto solver = solvers.make(
        "", {.transport = *transport, .root_area = scene.mesh().area.cwiseSqrt(), .options = {}});
    answer.errors =
        answer_errors(scene.mesh(), scene.emission, solve(*solver, scene.emission), scene.reference);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    answer.refusal = error.what();
  }
  return answer;
}

}  // namespace radiosity
