#include "apps/device_choice.hpp"
#include "apps/form_factor_options.hpp"
#include "apps/number_ranges.hpp"
#include "apps/output_check.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/scene_options.hpp"
#include "apps/terminal_monitor.hpp"
#include "experiments/comparison.hpp"
#include "experiments/comparison_plot.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/built_in.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {
namespace {

struct CompareOptions {
  SceneOptions scene;
  FormFactorChoice form_factors;
  ComparisonOptions comparison;
  RunOptions run;
  std::string lights;
  std::filesystem::path json_file;
  std::filesystem::path plot_file;
};

bool names_scene(const std::string& text) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(text, ignored) || names_built_in_scene(text);
}

/// --operators takes every word that follows it: a SCENE behind it would be swallowed.
void require_scene(const CompareOptions& options) {
  if (!options.scene.scene.empty()) return;
  const std::vector<std::string>& specs = options.comparison.operators;
  if (!specs.empty() && names_scene(specs.back()))
    fail<UsageError>(
        "no SCENE is given: --operators took '{}' for an operator; write the SCENE before it, as in "
        "'radiosity compare {} --operators ...'",
        specs.back(), specs.back());
  fail<UsageError>(
      "no SCENE is given: write it before --operators, as in 'radiosity compare cube --operators dense csr'");
}

/// A misspelt name must not cost an assembly; keys are checked when the operator is built.
void require_known_operators(const std::vector<std::string>& specs, const OperatorRegistry& operators) {
  std::string known;
  for (const OperatorEntry& entry : operators.entries()) known += (known.empty() ? "" : ", ") + entry.name;
  for (const std::string& text : specs) {
    const Spec spec = Spec::parse(text);
    const auto& entries = operators.entries();
    if (std::none_of(entries.begin(), entries.end(),
                     [&](const OperatorEntry& entry) { return entry.name == spec.name(); }))
      fail<UsageError>("there is no operator '{}'; the known ones are {}", spec.name(), known);
  }
}

std::vector<ComparisonPoint> plot_points(const Comparison& comparison) {
  std::vector<ComparisonPoint> points;
  for (const ComparisonResult& result : comparison.results)
    if (result.errors.radiosity_mean)
      points.push_back(
          {result.spec, static_cast<double>(result.bytes), result.apply.min, *result.errors.radiosity_mean});
  return points;
}

void run_compare(CompareOptions options, const Program& cpu_program) {
  const ThreadLimit limit(options.run.threads);
  require_scene(options);
  require_known_operators(options.comparison.operators, cpu_program.operators);
  const Program program = on_device(cpu_program, options.run, options.comparison.operators);
  require_writable(options.json_file);
  require_writable(options.plot_file, ".svg");
  require_writable(options.form_factors.save_file);
  if (!options.lights.empty()) options.comparison.lights = LightCounts::parse(options.lights);
  options.form_factors.options.seed = options.run.seed;
  options.comparison.seed = options.run.seed;

  TerminalMonitor monitor(options.run.quiet);
  const auto mesh = open_mesh(options.scene);
  const FormFactors form_factors = obtain_form_factors(mesh, options.form_factors, monitor);
  const Comparison comparison =
      compare(form_factors, program.operators, program.solvers, options.comparison, monitor);
  if (!options.json_file.empty()) write_comparison_json(options.json_file, comparison);
  if (!options.plot_file.empty())
    write_comparison_plot(options.plot_file, plot_points(comparison),
                          fmt::format("{}, {} patches", mesh->scene->name, mesh->patch_count()));

  monitor.clear();
  fmt::print("{}, {} patches, {} lights; {}, closure {}\n\n{}", mesh->scene->name, mesh->patch_count(),
             comparison.lights.lights.size(), form_factors.quality.method, form_factors.quality.closure,
             comparison_table(comparison));
  if (options.run.quiet) return;
  for (const std::string& note : mesh->notes) fmt::print("note: {}\n", note);
}

}  // namespace

void add_compare_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("compare", "bytes, time and error of operators on the same scene and lights");
  const auto options = std::make_shared<CompareOptions>();
  add_scene_options(*command, options->scene);
  command
      ->add_option("--operators", options->comparison.operators,
                   "one or more, separated by spaces (radiosity info --list)")
      ->required()
      ->expected(1, -1)
      ->option_text("SPEC ...");
  command
      ->add_option("--lights", options->lights,
                   "how many drawn lights, as in area:4,point:4,patch:2; default: the scene's own")
      ->option_text("KIND:N,...");
  command
      ->add_option("--solver", options->comparison.solver,
                   "default none where the operator maps E to B, cg where it is symmetric, else gmres")
      ->option_text("SPEC");
  command
      ->add_option("--tolerance", options->comparison.solver_options.tolerance,
                   "the solver's relative residual; default 1e-6")
      ->check(number_between(1e-15, 1, false))
      ->option_text("T");
  command->add_option("--json", options->json_file, "write the comparison as JSON")->option_text("FILE");
  command->add_option("--plot", options->plot_file, "draw error against bytes and against time")
      ->option_text("FILE.svg");
  add_form_factor_options(*command, options->form_factors);
  add_run_options(*command, options->run);
  command->callback([options, &program] { run_compare(*options, program); });
}

}  // namespace radiosity
