#include "apps/device_choice.hpp"
#include "apps/energy_balance.hpp"
#include "apps/form_factor_options.hpp"
#include "apps/group_summary.hpp"
#include "apps/number_ranges.hpp"
#include "apps/output_check.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/scene_options.hpp"
#include "apps/simplification.hpp"
#include "apps/solution.hpp"
#include "apps/solution_report.hpp"
#include "apps/terminal_monitor.hpp"
#include "experiments/lights.hpp"
#include "foundation/error.hpp"
#include "foundation/npy.hpp"
#include "foundation/parallel.hpp"
#include "render/reference_comparison.hpp"
#include "render/write_solution.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {
namespace {

struct SolveOptions {
  SceneOptions scene;
  FormFactorChoice form_factors;
  SolutionRequest request;
  std::optional<std::string> operator_spec;  ///< empty: what suits the device
  RunOptions run;
  std::string lights;
  std::optional<std::string> simplify;  ///< "voxels:N"; else the scene itself is solved
  bool no_certificate = false;
  Index certificate_rows = 0;  ///< 0: from products with the whole kernel
  std::filesystem::path error_bounds_file;
  bool reference = false;
  PathTracingOptions paths;
  PictureOptions picture;
  std::vector<std::filesystem::path> outputs;
  std::filesystem::path json_file;
};

void check_outputs(const SolveOptions& options) {
  for (const std::filesystem::path& output : options.outputs) {
    check_solution_format(output);
    require_writable(output);
  }
  require_writable(options.json_file);
  require_writable(options.error_bounds_file, ".npy");
  require_writable(options.form_factors.save_file);
}

/// The emission of the one light asked for; nothing where the scene's own counts.
std::optional<Field> drawn_light(const SolveOptions& options, const PatchMesh& mesh, Monitor& monitor) {
  if (options.lights.empty()) return std::nullopt;
  const LightCounts counts = LightCounts::parse(options.lights);
  if (counts.total() != 1)
    fail<UsageError>("--lights {}: solve takes one light, as in area:1; compare takes many", options.lights);
  return draw_lights(mesh, counts, options.run.seed, monitor).emission;
}

/// For an operator that is made from the mesh alone.
FormFactors without_factors(const SolveOptions& options, std::shared_ptr<const PatchMesh> mesh) {
  for (const auto* file : {&options.form_factors.save_file, &options.form_factors.kernel_file})
    if (!file->empty())
      fail<UsageError>("{}: {} assembles no form factors; leave the file out or take factors=sums",
                       file->string(), options.request.operator_spec);
  if (!options.error_bounds_file.empty())
    fail<UsageError>("--error-bounds needs products with F, which {} does not assemble: take factors=sums",
                     options.request.operator_spec);
  FormFactors form_factors;
  form_factors.mesh = std::move(mesh);
  return form_factors;
}

/// Certifies B of what was solved, or says in a note why it cannot.
std::optional<CertificateSummary> certify_solution(const SolveOptions& options,
                                                   const FormFactors& form_factors, const Field& emission,
                                                   const Field& radiosity, std::vector<std::string>& notes) {
  // Rows of their own: another seed, and a tolerance that leaves the assembled factors' error visible.
  if (options.certificate_rows > 0)
    return certify_from_rows(form_factors.mesh, options.certificate_rows,
                             options.form_factors.options.tolerance / 10, options.run.seed + 1, emission,
                             radiosity);
  if (!form_factors.kernel && !form_factors.unsymmetric) {
    notes.emplace_back("no F was assembled to certify B with: --certificate-rows N samples it");
    return std::nullopt;
  }
  const auto certifier = Certifier::make(form_factors, options.run.seed);
  return certifier ? std::optional(certifier->certify(emission, radiosity)) : std::nullopt;
}

void run_solve(SolveOptions options, const Program& cpu_program) {
  const ThreadLimit limit(options.run.threads);
  options.request.operator_spec =
      options.operator_spec.value_or(options.run.device == "gl" ? "dense:f32" : "dense");
  const Program program = on_device(cpu_program, options.run, {options.request.operator_spec});
  check_outputs(options);
  const std::optional<Index> voxels = wanted_voxels(options.simplify);
  options.form_factors.options.seed = options.run.seed;
  options.paths.seed = options.run.seed;

  TerminalMonitor monitor(options.run.quiet);
  const auto original = open_mesh(options.scene);
  const std::optional<Field> drawn = drawn_light(options, *original, monitor);
  const Field& original_emission = drawn ? *drawn : original->emission;
  std::optional<Simplification> simplification;
  if (voxels) {
    monitor.checkpoint("simplification", 0);
    simplification.emplace(*original, original_emission, *voxels);
  }
  // What is solved: itself, or what is simplified.
  const std::shared_ptr<const PatchMesh> mesh = simplification ? simplification->mesh() : original;
  const Field& emission = simplification ? mesh->emission : original_emission;
  const bool assembled = program.operators.needs_form_factors(options.request.operator_spec);
  const FormFactors form_factors =
      assembled ? obtain_form_factors(mesh, options.form_factors, monitor) : without_factors(options, mesh);

  std::vector<std::string> notes = original->notes;
  SolutionReport report;
  report.solution = solve_scene(form_factors, emission, options.request, program, monitor);
  report.energy = energy_balance(*mesh, emission, report.solution.radiosity, report.solution.irradiance);
  if (!options.no_certificate) {
    monitor.checkpoint("certificate", 0);
    report.certificate = certify_solution(options, form_factors, emission, report.solution.radiosity, notes);
  }
  Field error_bounds;
  if (!options.error_bounds_file.empty())
    error_bounds = bound_patch_errors(form_factors, emission, report.solution.radiosity);
  const Field simplified_radiosity =
      simplification ? simplification->patches(report.solution.irradiance) : Field();
  const Field& radiosity = simplification ? simplified_radiosity : report.solution.radiosity;
  if (simplification) {
    report.simplification = simplification->summary();
    notes.push_back(simplification->note());
  }
  report.groups = summarize_groups(*original, radiosity);
  if (options.reference) {
    PatchMesh lit = *original;
    lit.emission = original_emission;
    report.reference = compare_with_reference(lit, radiosity, trace_paths(lit, options.paths, monitor));
  }

  if (!form_factors.quality.closure_note.empty()) notes.push_back(form_factors.quality.closure_note);
  const Field corners = simplification && options.picture.interpolate
                            ? simplification->corners(report.solution.irradiance)
                            : Field();
  for (const std::filesystem::path& output : options.outputs)
    notes.push_back(write_solution(output, *original, radiosity, options.picture, monitor, corners));
  if (!options.error_bounds_file.empty()) write_npy(options.error_bounds_file, error_bounds);
  if (!options.json_file.empty()) write_solution_json(options.json_file, form_factors, report);
  monitor.clear();
  print_solution(form_factors, report);
  if (!options.run.quiet)
    for (const std::string& note : notes) fmt::print("note: {}\n", note);
}

}  // namespace

void add_solve_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("solve", "the radiosity of a scene, as numbers, a picture or a lit mesh");
  const auto options = std::make_shared<SolveOptions>();
  add_scene_options(*command, options->scene);
  command
      ->add_option("--operator", options->operator_spec,
                   "default dense, or dense:f32 with --device gl (radiosity info --list)")
      ->option_text("SPEC");
  command
      ->add_option("--solver", options->request.solver_spec,
                   "default none where the operator maps E to B, cg where it is symmetric, else gmres")
      ->option_text("SPEC");
  command
      ->add_option("--tolerance", options->request.tolerance, "the solver's relative residual; default 1e-6")
      ->check(number_between(1e-15, 1, false))
      ->option_text("T");
  command
      ->add_option("--lights", options->lights,
                   "one drawn light in place of the scene's: area:1, point:1 or patch:1")
      ->option_text("KIND:1");
  command
      ->add_option("-o,--output", options->outputs,
                   "write the solution as .glb, .ply, .exr, .png or .npy; may be repeated")
      ->expected(1, -1)
      ->allow_extra_args(false)
      ->option_text("OUT");
  command->add_option("--width", options->picture.width, "of the picture, pixels; default 800")
      ->check(integer_between(1, 16384))
      ->option_text("PIXELS");
  command->add_option("--height", options->picture.height, "of the picture, pixels; default 800")
      ->check(integer_between(1, 16384))
      ->option_text("PIXELS");
  command->add_flag("--interpolate", options->picture.interpolate,
                    "shade the picture smoothly in place of flat patches");
  CLI::Option* simplify = add_simplify_option(*command, options->simplify);
  command
      ->add_option("--error-bounds", options->error_bounds_file,
                   "write a proved bound on the error of each patch's radiosity, for this F")
      ->excludes(simplify)
      ->option_text("FILE.npy");
  CLI::Option* none =
      command->add_flag("--no-certificate", options->no_certificate,
                        "do not bound the error of B, which takes some products with the true kernel");
  command
      ->add_option(
          "--certificate-rows", options->certificate_rows,
          "bound the error of B, that of F included, from N rows of F computed afresh, with 99 % confidence")
      ->check(integer_between(32, 1 << 24))
      ->excludes(none)
      ->option_text("N");
  command->add_flag("--reference", options->reference,
                    "compare with path tracing, which shares no transport code");
  command->add_option("--reference-paths", options->paths.paths, "paths from each patch; default 1024")
      ->check(integer_between(64, 1 << 24))
      ->option_text("N");
  command->add_option("--json", options->json_file, "write the summary as JSON")->option_text("FILE");
  add_form_factor_options(*command, options->form_factors);
  add_run_options(*command, options->run);
  command->callback([options, &program] { run_solve(*options, program); });
}

}  // namespace radiosity
