// The JSON of `compare` and of `form-factors` (architecture.md, "Contracts with the user"): keys stay as they
// are; a value that does not exist is null.

#include "experiments/comparison.hpp"
#include "experiments/form_factor_report.hpp"
#include "experiments/json_objects.hpp"

#include <nlohmann/json.hpp>

namespace radiosity {

namespace {

Json timing_json(const Timing& timing) {
  return {{"min", timing.min}, {"median", timing.median}};
}

Json result_json(const ComparisonResult& result) {
  const ComparisonErrors& errors = result.errors;
  return {{"operator", result.spec},
          {"solver", result.solver.empty() ? Json() : Json(result.solver)},
          {"device", device_name(result.device)},
          {"renderer", renderer_json(result.device)},
          {"device_difference_max", device_difference_json(result.device)},
          {"bytes", result.bytes},
          {"build_seconds", result.build_seconds},
          {"apply_seconds", timing_json(result.apply)},
          {"solve_seconds", timing_json(result.solve)},
          {"error",
           {{"operator_frobenius", or_null(errors.operator_frobenius)},
            {"radiosity_mean", or_null(errors.radiosity_mean)},
            {"radiosity_max", or_null(errors.radiosity_max)},
            {"indirect_mean", or_null(errors.indirect_mean)},
            {"indirect_max", or_null(errors.indirect_max)}}},
          {"row_sum_min", or_null(result.row_sum_min)},
          {"row_sum_max", or_null(result.row_sum_max)},
          {"spectral_radius", or_null(result.spectral_radius)},
          {"iterations", result.iterations},
          {"certificate", certificate_json(result.certificate)},
          {"remark", result.remark.empty() ? Json() : Json(result.remark)}};
}

}  // namespace

void write_comparison_json(const std::filesystem::path& file, const Comparison& comparison) {
  Json results = Json::array();
  for (const ComparisonResult& result : comparison.results) results.push_back(result_json(result));
  write_json(file, {{"scene", scene_json(*comparison.form_factors.mesh)},
                    {"machine", machine_json(comparison.machine)},
                    {"form_factors", form_factors_json(comparison.form_factors.quality)},
                    {"results", results}});
}

void write_form_factor_json(const std::filesystem::path& file, const FormFactors& form_factors,
                            const Machine& machine, const std::optional<GroupFormFactors>& groups) {
  Json document = {{"scene", scene_json(*form_factors.mesh)},
                   {"machine", machine_json(machine)},
                   {"form_factors", form_factors_json(form_factors.quality)}};
  if (groups) {
    document["groups"] = groups->names;
    document["areas"] = numbers_json(groups->areas);
    document["matrix"] = matrix_json(groups->matrix);
    document["standard_error"] = groups->standard_error ? matrix_json(*groups->standard_error) : Json();
  }
  write_json(file, document);
}

}  // namespace radiosity
