#include "apps/solution_report.hpp"

#include "apps/device_choice.hpp"
#include "apps/memory_need.hpp"
#include "experiments/json_objects.hpp"
#include "foundation/memory.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace radiosity {
namespace {

double percent(double part, double whole) {
  return whole > 0 ? 100 * part / whole : 0;
}

void print_energy(const EnergyBalance& energy) {
  if (energy.emitted == 0) {
    fmt::print(
        "\nnothing emits: the radiosity is 0 (--emission, --set GROUP:emission=... and --lights add "
        "light)\n");
    return;
  }
  fmt::print("\nenergy     {:.6g} W emitted, {:.6g} W absorbed ({:.2f} %), {:.6g} W lost ({:.2f} %)\n",
             energy.emitted, energy.absorbed, percent(energy.absorbed, energy.emitted), energy.lost,
             percent(energy.lost, energy.emitted));
}

void print_reference(const ReferenceComparison& reference) {
  fmt::print(
      "\nreference  mean of the reflected light {:+.3f} % +- {:.3f} % (one standard error) from path "
      "tracing, single patches {:.3f} % rms\n",
      100 * reference.mean_difference, 100 * reference.mean_difference_standard_error,
      100 * reference.rms_difference);
  fmt::print("{:<24} {:>14} {:>14} {:>14}\n", "group", "path traced", "difference", "its error");
  for (const GroupDifference& group : reference.groups)
    fmt::print("{:<24} {:>14.6g} {:>14.3g} {:>14.3g}\n", group.group, group.reference, group.difference,
               group.standard_error);
}

void print_certificate(const CertificateSummary& certificate) {
  if (!certificate.bound) {
    fmt::print("certified  nothing: the system may be singular, or the answer is too far off\n");
    return;
  }
  const std::string odds =
      certificate.confidence < 1 ? fmt::format(", with probability {:.6g}", certificate.confidence) : "";
  if (certificate.from_rows)
    fmt::print(
        "certified  B is right to {:.2g} of its norm, errors of F included ({}, {:.3g} of the rows of F{})\n",
        *certificate.bound, certificate.kind, certificate.products, odds);
  else
    fmt::print("certified  B is right to {:.2g} of its norm for this F ({}, {} vectors, {:.3g} products{})\n",
               *certificate.bound, certificate.kind, certificate.vectors, certificate.products, odds);
}

Json reference_json(const ReferenceComparison& reference) {
  Json groups = Json::array();
  for (const GroupDifference& group : reference.groups)
    groups.push_back({{"name", group.group},
                      {"reference", group.reference},
                      {"difference", group.difference},
                      {"standard_error", group.standard_error}});
  return {{"mean_difference", reference.mean_difference},
          {"mean_difference_standard_error", reference.mean_difference_standard_error},
          {"rms_difference", reference.rms_difference},
          {"rms_standard_error", reference.rms_standard_error},
          {"beyond_four_standard_errors", reference.beyond_four_standard_errors},
          {"groups", groups}};
}

Json simplification_json(const SimplificationSummary& simplification) {
  return {{"triangles", simplification.triangles}, {"original_patches", simplification.original_patches},
          {"patches", simplification.patches},     {"cell", numbers_json(simplification.cell)},
          {"seconds", simplification.seconds},     {"transfer_seconds", simplification.transfer_seconds}};
}

}  // namespace

void print_solution(const FormFactors& form_factors, const SolutionReport& report) {
  const PatchMesh& mesh = *form_factors.mesh;
  const FormFactorQuality& quality = form_factors.quality;
  const Solution& solution = report.solution;
  fmt::print("scene      {}, {} patches, {} channel{}\n", mesh.scene->name, mesh.patch_count(),
             mesh.channels(), mesh.channels() == 1 ? "" : "s");
  if (quality.method.empty())
    fmt::print("factors    not assembled: the operator was made from the meshes\n");
  else
    fmt::print("factors    {}, closure {}, rows sum to {:.6g} ... {:.6g}, {:.3g} s\n", quality.method,
               quality.closure, quality.row_sum_min, quality.row_sum_max, quality.seconds);
  fmt::print("operator   {}, {}, built in {:.3g} s\n", solution.operator_name,
             byte_text(static_cast<double>(solution.bytes)), solution.build_seconds);
  fmt::print("{}", device_line(solution.device));
  if (solution.solver_name.empty())
    fmt::print("solver     none: the operator answers by itself, {:.3g} s\n", solution.solve_seconds);
  else
    fmt::print("solver     {}, {} products, residual {:.2g}, {:.3g} s\n", solution.solver_name,
               solution.products, solution.residual, solution.solve_seconds);
  if (report.certificate) print_certificate(*report.certificate);
  fmt::print("\n{:<24} {:>12}   {}\n", "group", "area", "mean radiosity, W/m^2");
  for (const GroupSummary& group : report.groups)
    fmt::print("{:<24} {:>12.6g}   {}\n", group.name, group.area, channel_text(group.mean));
  print_energy(report.energy);
  if (report.reference) print_reference(*report.reference);
}

void write_solution_json(const std::filesystem::path& file, const FormFactors& form_factors,
                         const SolutionReport& report) {
  const Solution& solution = report.solution;
  Json groups = Json::array();
  for (const GroupSummary& group : report.groups)
    groups.push_back({{"name", group.name}, {"area", group.area}, {"radiosity", numbers_json(group.mean)}});
  const Json energy = {
      {"emitted", report.energy.emitted}, {"absorbed", report.energy.absorbed}, {"lost", report.energy.lost}};
  write_json(file, {{"scene", scene_json(*form_factors.mesh)},
                    {"form_factors", form_factors_json(form_factors.quality)},
                    {"operator", solution.operator_name},
                    {"solver", solution.solver_name.empty() ? Json() : Json(solution.solver_name)},
                    {"device", device_name(solution.device)},
                    {"renderer", renderer_json(solution.device)},
                    {"device_difference_max", device_difference_json(solution.device)},
                    {"upload_seconds", solution.device ? Json(solution.device->upload_seconds) : Json()},
                    {"device_seconds", solution.device ? Json(solution.device->device_seconds) : Json()},
                    {"bytes", solution.bytes},
                    {"build_seconds", solution.build_seconds},
                    {"solve_seconds", solution.solve_seconds},
                    {"iterations", solution.products},
                    {"residual", std::isnan(solution.residual) ? Json() : Json(solution.residual)},
                    {"certificate", certificate_json(report.certificate)},
                    {"groups", groups},
                    {"energy", energy},
                    {"reference", report.reference ? reference_json(*report.reference) : Json(nullptr)},
                    {"simplification",
                     report.simplification ? simplification_json(*report.simplification) : Json(nullptr)}});
}

}  // namespace radiosity
