#include "experiments/first_light_files.hpp"

#include "experiments/json_objects.hpp"
#include "foundation/output_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace radiosity {
namespace {

Json difference_json(const ReferenceComparison& difference) {
  return {{"mean", difference.mean_difference},
          {"mean_standard_error", difference.mean_difference_standard_error},
          {"rms", difference.rms_difference},
          {"rms_standard_error", difference.rms_difference_standard_error},
          {"beyond_four_standard_errors", difference.beyond_four_standard_errors}};
}

Json solution_json(const FirstLightSolution& solution) {
  return {{"form_factors", form_factors_json(solution.quality)},
          {"error", {{"radiosity", solution.radiosity_error}, {"indirect", solution.indirect_error}}},
          {"difference_from_referee", difference_json(solution.difference)}};
}

Json operator_json(const ComparisonResult& result) {
  return {{"operator", result.spec},
          {"solver", result.solver},
          {"bytes", result.bytes},
          {"build_seconds", result.build_seconds},
          {"apply_seconds", {{"min", result.apply.min}, {"median", result.apply.median}}},
          {"solve_seconds", {{"min", result.solve.min}, {"median", result.solve.median}}},
          {"error",
           {{"operator_frobenius", or_null(result.errors.operator_frobenius)},
            {"radiosity", or_null(result.errors.radiosity_mean)},
            {"indirect", or_null(result.errors.indirect_mean)}}},
          {"iterations", result.iterations}};
}

Json size_json(const FirstLightSize& size) {
  Json operators = Json::array();
  for (const ComparisonResult& result : size.operators) operators.push_back(operator_json(result));
  return {{"scene", scene_json(*size.mesh)},
          {"raw_row_sum_rms", size.raw_row_sum_rms},
          {"accurate", solution_json(size.accurate)},
          {"one_ray", solution_json(size.one_ray)},
          {"operators", operators},
          {"referee",
           {{"paths", size.referee.paths},
            {"rays", size.referee.rays},
            {"leaks", size.referee.leaks},
            {"back_hits", size.referee.back_hits},
            {"relative_standard_error", size.referee.relative_standard_error(size.mesh->area)},
            {"seconds", size.referee.seconds}}}};
}

/// A number for CSV; empty where there is none.
std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

}  // namespace

void write_first_light_json(const std::filesystem::path& file, const FirstLightMeasurement& measurement) {
  Json sizes = Json::array();
  for (const FirstLightSize& size : measurement.sizes) sizes.push_back(size_json(size));
  write_json(file, {{"machine", machine_json(measurement.machine)}, {"sizes", sizes}});
}

void write_first_light_csv(const std::filesystem::path& file, const FirstLightMeasurement& measurement) {
  OutputFile output(file);
  output.stream() << "patches,form_factors,operator,bytes,apply_seconds,solve_seconds,products,"
                     "operator_error,radiosity_error,indirect_error\n";
  for (const FirstLightSize& size : measurement.sizes) {
    for (const ComparisonResult& result : size.operators)
      output.stream() << fmt::format("{},accurate,{},{},{:.6g},{:.6g},{},{},{},{}\n",
                                     size.mesh->patch_count(), result.spec, result.bytes, result.apply.min,
                                     result.solve.min, result.iterations,
                                     cell(result.errors.operator_frobenius),
                                     cell(result.errors.radiosity_mean), cell(result.errors.indirect_mean));
    output.stream() << fmt::format("{},one-ray,dense,,,,,,{:.6g},{:.6g}\n", size.mesh->patch_count(),
                                   size.one_ray.radiosity_error, size.one_ray.indirect_error);
  }
  output.commit();
}

}  // namespace radiosity
