#include "apps/device_choice.hpp"
#include "apps/form_factor_options.hpp"
#include "apps/output_check.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/scene_options.hpp"
#include "apps/terminal_monitor.hpp"
#include "experiments/form_factor_report.hpp"
#include "experiments/machine.hpp"
#include "foundation/npy.hpp"
#include "foundation/parallel.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace radiosity {
namespace {

struct FormFactorsCommandOptions {
  SceneOptions scene;
  FormFactorChoice form_factors;
  RunOptions run;
  bool groups = false;
  std::filesystem::path matrix_file;
  std::filesystem::path json_file;
};

void print_quality(const FormFactors& form_factors) {
  const FormFactorQuality& quality = form_factors.quality;
  fmt::print("scene        {}, {} patches\n", form_factors.mesh->scene->name, form_factors.patch_count());
  fmt::print("method       {}, closure {}\n", quality.method, quality.closure);
  fmt::print("row sums     {:.9g} ... {:.9g}, off what is exposed by {:.2g} rms\n", quality.row_sum_min,
             quality.row_sum_max, quality.row_sum_rms);
  fmt::print("reciprocity  broken by at most {:.2g}\n", quality.reciprocity_max);
  fmt::print("back hits    {} of {} probe rays\n", quality.back_hits, quality.probe_rays);
  fmt::print("leaks        {}\n", quality.leaks);
  fmt::print("rays         {}\n", quality.rays);
  fmt::print("time         {:.3g} s, {:.3g} s of CPU\n", quality.seconds, quality.cpu_seconds);
}

void run_form_factors(FormFactorsCommandOptions options) {
  const ThreadLimit limit(options.run.threads);
  require_cpu(options.run, "form-factors");
  require_writable(options.matrix_file, ".npy");
  require_writable(options.json_file);
  require_writable(options.form_factors.save_file);
  options.form_factors.options.seed = options.run.seed;

  TerminalMonitor monitor(options.run.quiet);
  const auto mesh = open_mesh(options.scene);
  const FormFactors form_factors = obtain_form_factors(mesh, options.form_factors, monitor);
  std::optional<GroupFormFactors> groups;
  if (options.groups) groups = group_form_factors(form_factors);
  if (!options.matrix_file.empty()) write_npy(options.matrix_file, form_factors.matrix());
  if (!options.json_file.empty())
    write_form_factor_json(options.json_file, form_factors, measure_machine(), groups);

  monitor.clear();
  print_quality(form_factors);
  if (groups) fmt::print("\nF from the group of a row to that of a column\n{}", group_table(*groups));
  if (options.run.quiet) return;
  for (const std::string& note : mesh->notes) fmt::print("note: {}\n", note);
  if (!form_factors.quality.closure_note.empty()) fmt::print("note: {}\n", form_factors.quality.closure_note);
}

}  // namespace

void add_form_factors_command(CLI::App& app, const Program&) {
  CLI::App* command = app.add_subcommand(
      "form-factors", "the form factors of a scene, their quality, and those between groups");
  const auto options = std::make_shared<FormFactorsCommandOptions>();
  add_scene_options(*command, options->scene);
  command->add_option("-o,--output", options->matrix_file, "write the matrix F, n x n")->option_text("F.npy");
  command->add_flag("--groups", options->groups, "also F between the named groups of the scene");
  command->add_option("--json", options->json_file, "write quality and groups as JSON")->option_text("FILE");
  add_form_factor_options(*command, options->form_factors);
  add_run_options(*command, options->run);
  command->callback([options] { run_form_factors(*options); });
}

}  // namespace radiosity
