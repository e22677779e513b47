// low_rank_errors.json, low_rank_errors.csv, low_rank_spectra.csv.

#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/error_study.hpp"
#include "foundation/output_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace radiosity {
namespace {

Json problem_json(const ErrorStudyProblem& problem) {
  return {
      {"scene", problem.scene}, {"patches", problem.patches}, {"reflectance", or_null(problem.reflectance)}};
}

Json light_errors_json(const LightErrors& errors) {
  return {{"radiosity_mean", errors.radiosity_mean},    {"radiosity_rms", errors.radiosity_rms},
          {"radiosity_max", errors.radiosity_max},      {"indirect_mean", errors.indirect_mean},
          {"indirect_max", errors.indirect_max},        {"area_lights", or_null(errors.of_kind[0])},
          {"point_lights", or_null(errors.of_kind[1])}, {"patch_lights", or_null(errors.of_kind[2])}};
}

Json row_json(const LowRankError& row) {
  Json json = problem_json(row.problem);
  json.update({{"factorization", row.factorization},
               {"k", row.k},
               {"rank", row.rank},
               {"bytes_per_patch", row.bytes_per_patch},
               {"operator_error", row.operator_error},
               {"spectral_radius", row.spectral_radius},
               {"errors", row.errors ? light_errors_json(*row.errors) : Json()},
               {"refusal", row.refusal.empty() ? Json() : Json(row.refusal)}});
  return json;
}

Json bound_json(const BestRankError& bound) {
  Json json = problem_json(bound.problem);
  json.update({{"rank", bound.rank},
               {"errors", light_errors_json(bound.errors)},
               {"alone",
                {{"area_lights", or_null(bound.alone[0])},
                 {"point_lights", or_null(bound.alone[1])},
                 {"patch_lights", or_null(bound.alone[2])}}}});
  return json;
}

Json spectrum_json(const SpectrumStudy& spectrum) {
  return {{"scene", spectrum.scene},
          {"patches", spectrum.patches},
          {"adjacent_pairs", spectrum.adjacent_pairs},
          {"singular_values", spectrum.singular_values},
          {"eigenvalues", spectrum.eigenvalues},
          {"without_adjacent", spectrum.without_adjacent}};
}

template <typename List, typename Convert>
Json list_json(const List& list, const Convert& convert) {
  Json json = Json::array();
  for (const auto& item : list) json.push_back(convert(item));
  return json;
}

std::string problem_cells(const ErrorStudyProblem& problem) {
  return fmt::format("{},{},{}", problem.scene, problem.patches,
                     problem.reflectance ? fmt::format("{}", *problem.reflectance) : "");
}

std::string error_cells_of(const LightErrors& errors) {
  return fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", errors.radiosity_mean, errors.radiosity_rms,
                     errors.radiosity_max, errors.indirect_mean, errors.indirect_max);
}

std::string error_lines(const ErrorStudy& study) {
  std::string lines =
      "scene,patches,reflectance,factorization,k,rank,bytes_per_patch,operator_error,spectral_radius,"
      "radiosity_mean,radiosity_rms,radiosity_max,indirect_mean,indirect_max\n";
  for (const LowRankError& row : study.factorizations)
    lines += fmt::format("{},\"{}\",{},{},{:.6g},{:.6g},{:.6g},{}\n", problem_cells(row.problem),
                         row.factorization, row.k, row.rank, row.bytes_per_patch, row.operator_error,
                         row.spectral_radius, row.errors ? error_cells_of(*row.errors) : ",,,,");
  for (const BestRankError& bound : study.bounds)
    lines += fmt::format("{},\"best of rank k\",{},{},,,,{}\n", problem_cells(bound.problem), bound.rank,
                         bound.rank, error_cells_of(bound.errors));
  return lines;
}

std::string spectrum_lines(const ErrorStudy& study) {
  std::string lines = "scene,patches,number,singular_value,eigenvalue,without_adjacent\n";
  for (const SpectrumStudy& spectrum : study.spectra)
    for (std::size_t k = 0; k < spectrum.eigenvalues.size(); ++k)
      lines +=
          fmt::format("{},{},{},{:.6g},{:.6g},{:.6g}\n", spectrum.scene, spectrum.patches, k + 1,
                      spectrum.singular_values[k], spectrum.eigenvalues[k], spectrum.without_adjacent[k]);
  return lines;
}

void write_lines(const std::filesystem::path& path, const std::string& lines) {
  OutputFile file(path);
  file.stream() << lines;
  file.commit();
}

}  // namespace

void write_error_study(const std::filesystem::path& folder, const ErrorStudy& study) {
  write_json(folder / "low_rank_errors.json", {{"factorizations", list_json(study.factorizations, row_json)},
                                               {"best_of_rank", list_json(study.bounds, bound_json)},
                                               {"spectra", list_json(study.spectra, spectrum_json)}});
  write_lines(folder / "low_rank_errors.csv", error_lines(study));
  write_lines(folder / "low_rank_spectra.csv", spectrum_lines(study));
}

}  // namespace radiosity
