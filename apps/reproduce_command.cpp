#include "apps/device_choice.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/terminal_monitor.hpp"
#include "experiments/device/device_results.hpp"
#include "experiments/dxt_radiosity/dxt_errors.hpp"
#include "experiments/dxt_radiosity/dxt_pictures.hpp"
#include "experiments/dxt_radiosity/dxt_speed.hpp"
#include "experiments/dxt_radiosity/dxt_voxels.hpp"
#include "experiments/dxt_radiosity/frame_comparison.hpp"
#include "experiments/first_light.hpp"
#include "experiments/hard_cases.hpp"
#include "experiments/low_rank_radiosity/changing_lights.hpp"
#include "experiments/low_rank_radiosity/coherence_pictures.hpp"
#include "experiments/low_rank_radiosity/equal_cost.hpp"
#include "experiments/low_rank_radiosity/error_study.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "experiments/low_rank_radiosity/moved_object.hpp"
#include "experiments/machine.hpp"
#include "experiments/report.hpp"
#include "experiments/solver_study.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {
namespace {

struct ReproduceOptions {
  std::vector<std::string> tables;
  bool full = false;
  std::filesystem::path folder = "results";
  std::filesystem::path device_results_file;
  std::shared_ptr<const DeviceResults> device;  ///< what is in it; null: none
  RunOptions run;
};

struct Experiment {
  const char* name;
  ReportSection (*run)(const ReproduceOptions& options, const std::string& command, const Program& program,
                       Monitor& monitor);
};

ReportSection run_first_light(const ReproduceOptions& options, const std::string& command,
                              const Program& program, Monitor& monitor) {
  FirstLightOptions sizes;
  if (options.full) {
    sizes.patches = {300, 800, 1600, 3300, 6600, 13000};
    sizes.reference_paths = 32768;
  }
  sizes.seed = options.run.seed;
  return first_light(options.folder, command, sizes, program.operators, program.solvers, monitor);
}

ReportSection run_solvers(const ReproduceOptions& options, const std::string& command, const Program& program,
                          Monitor& monitor) {
  SolverStudyOptions study;
  if (options.full) {
    study.patches_a_room = 600;
    study.max_products = 100000;
  }
  study.seed = options.run.seed;
  return solver_study(options.folder, command, study, program.operators, program.solvers, monitor);
}

ReportSection run_hard_case_tables(const ReproduceOptions& options, const std::string& command,
                                   const Program& program, Monitor& monitor) {
  return hard_cases(options.folder, command, program.operators, program.solvers, monitor);
}

ReportSection run_low_rank_errors(const ReproduceOptions& options, const std::string& command,
                                  const Program& program, Monitor& monitor) {
  ErrorStudyOptions study;
  if (options.full) {
    study.scenes = {"cube", "cornell-box-closed", "patio", "clutter"};
    study.patches = 3300;
    study.reflectances = {0.3, 0.5, 0.73, 0.9, 0.99};
    study.rank_step = 2;
    study.lights = {.area = 8, .point = 8, .patch = 8};
    study.training = {.area = 200, .point = 200};
  }
  study.seed = options.run.seed;
  return low_rank_errors(options.folder, command, study, program.operators, monitor);
}

ReportSection run_low_rank_tables(const ReproduceOptions& options, const std::string& command,
                                  const Program& /*program*/, Monitor& monitor) {
  LowRankTablesOptions study;
  if (options.full) {
    study.largest_timed = 1e9;
    study.largest_computed = 1e9;
    study.largest_dense_error = 13824;
    study.seconds = 4;
    study.streamed_seconds = 12;
  }
  study.seed = options.run.seed;
  study.device = options.device;
  return low_rank_tables(options.folder, command, study, monitor);
}

ReportSection run_low_rank_pictures(const ReproduceOptions& options, const std::string& command,
                                    const Program&, Monitor& monitor) {
  CoherencePictureOptions pictures;
  if (options.full) {
    pictures.view_patches = 3300;
    pictures.directions = 1024;
    pictures.picture_size = 840;
  }
  pictures.seed = options.run.seed;
  return low_rank_pictures(options.folder, command, pictures, monitor);
}

ReportSection run_low_rank_patio(const ReproduceOptions& options, const std::string& command,
                                 const Program& /*program*/, Monitor& monitor) {
  ChangingLightsOptions patio;
  if (options.full) {
    patio.patches = 24128;
    patio.coarse_patches = 1364;
    patio.pictures = patio.frames;
    patio.largest_dense = patio.patches;
    patio.seconds = 4;
  }
  patio.seed = options.run.seed;
  return changing_lights(options.folder, command, patio, monitor);
}

ReportSection run_low_rank_motion(const ReproduceOptions& options, const std::string& command,
                                  const Program& /*program*/, Monitor& monitor) {
  MovedObjectOptions motion;
  if (options.full) {
    motion.patches = 5600;
    motion.coarse_patches = 640;
    motion.steps = 8;
  }
  motion.seed = options.run.seed;
  return moved_object(options.folder, command, motion, monitor);
}

ReportSection run_low_rank_sides(const ReproduceOptions& options, const std::string& command,
                                 const Program& program, Monitor& monitor) {
  EqualCostOptions sides;
  if (options.full) {
    sides.patches = 3300;
    sides.ranks = {103, 206, 412};
  }
  sides.seed = options.run.seed;
  return equal_cost(options.folder, command, sides, program.operators, program.solvers, monitor);
}

ReportSection run_dxt_errors(const ReproduceOptions& options, const std::string& command,
                             const Program& program, Monitor& monitor) {
  DxtErrorsOptions study;
  if (options.full) study.patches = 3300;
  study.seed = options.run.seed;
  return dxt_errors(options.folder, command, study, program.operators, program.solvers, monitor);
}

ReportSection run_dxt_speed(const ReproduceOptions& options, const std::string& command,
                            const Program& program, Monitor& monitor) {
  DxtSpeedOptions study;
  if (options.full) {
    study.patches = {400, 800, 1600, 3300};
    study.patches_beyond_cache = {6500, 9500};
    study.patches_over_bounces = 3300;
    study.seconds = 4;
  }
  study.seed = options.run.seed;
  study.device = options.device;
  return dxt_speed(options.folder, command, study, program.operators, program.solvers, monitor);
}

ReportSection run_dxt_pictures(const ReproduceOptions& options, const std::string& command,
                               const Program& program, Monitor& monitor) {
  DxtPicturesOptions pictures;
  if (options.full) {
    pictures.patches = 1600;
    pictures.picture_size = 840;
  }
  pictures.seed = options.run.seed;
  return dxt_pictures(options.folder, command, pictures, program.operators, monitor);
}

ReportSection run_dxt_voxels(const ReproduceOptions& options, const std::string& command, const Program&,
                             Monitor& monitor) {
  DxtVoxelsOptions study;
  if (options.full) {
    for (VoxelStudyScene& scene : study.scenes) scene.patches = 6600;
    study.wanted = {50, 100, 200, 400, 800, 1600, 3200};
    study.lights = {.area = 6, .point = 6};
    study.tolerance = 1e-3;
  }
  study.seed = options.run.seed;
  return dxt_voxels(options.folder, command, study, monitor);
}

ReportSection run_frame_comparison(const ReproduceOptions& options, const std::string& command,
                                   const Program& program, Monitor& monitor) {
  FrameComparisonOptions comparison;
  if (options.full) {
    comparison.patches = 3300;
    comparison.tolerance = 1e-3;
    comparison.width = 640;
    comparison.height = 360;
    comparison.bands = 32;
    comparison.reference_paths = 512;
    comparison.seconds = 4;
  }
  comparison.seed = options.run.seed;
  RunOptions on_device = options.run;
  on_device.device = "gl";
  std::shared_ptr<GlDevice> device;
  try {
    device = open_device(on_device);
  } catch (const Error& error) {
    return skipped_frame_comparison(error.what());
  }
  return frame_comparison(options.folder, command, device, comparison, program.operators, monitor);
}

constexpr std::array<Experiment, 14> experiments = {{{"first-light", run_first_light},
                                                     {"solvers", run_solvers},
                                                     {"hard-cases", run_hard_case_tables},
                                                     {"low-rank-pictures", run_low_rank_pictures},
                                                     {"low-rank-errors", run_low_rank_errors},
                                                     {"low-rank-sides", run_low_rank_sides},
                                                     {"low-rank-tables", run_low_rank_tables},
                                                     {"low-rank-patio", run_low_rank_patio},
                                                     {"low-rank-motion", run_low_rank_motion},
                                                     {"dxt-errors", run_dxt_errors},
                                                     {"dxt-speed", run_dxt_speed},
                                                     {"dxt-pictures", run_dxt_pictures},
                                                     {"dxt-voxels", run_dxt_voxels},
                                                     {"frame-comparison", run_frame_comparison}}};

/// "first-light, solvers, ...".
std::string known_tables() {
  std::string known;
  for (const Experiment& experiment : experiments)
    known += (known.empty() ? "" : ", ") + std::string(experiment.name);
  return known;
}

void require_known_tables(const std::vector<std::string>& tables) {
  for (const std::string& table : tables)
    if (std::none_of(experiments.begin(), experiments.end(),
                     [&](const Experiment& e) { return table == e.name; }))
      fail<UsageError>("there is no table '{}'; the known ones are {}", table, known_tables());
}

bool wanted(const ReproduceOptions& options, const Experiment& experiment) {
  return options.tables.empty() ||
         std::find(options.tables.begin(), options.tables.end(), experiment.name) != options.tables.end();
}

std::string machine_text(const Machine& machine) {
  return fmt::format("{}, {} thread{}, {:.1f} GB/s read bandwidth, load {:.1f} at the start", machine.cpu,
                     machine.threads, machine.threads == 1 ? "" : "s", machine.read_bandwidth_gb_s,
                     machine.load);
}

/// The command that makes one section again.
std::string command_of(const ReproduceOptions& options, const Experiment& experiment) {
  std::string command =
      fmt::format("radiosity reproduce {}{}", experiment.name, options.full ? " --full" : "");
  if (options.device) command += " --device-results " + options.device_results_file.string();
  return command;
}

void run_reproduce(ReproduceOptions options, const Program& program) {
  const ThreadLimit limit(options.run.threads);
  require_cpu(options.run, "reproduce");
  require_known_tables(options.tables);
  if (!options.device_results_file.empty())
    options.device = std::make_shared<const DeviceResults>(read_device_results(options.device_results_file));
  TerminalMonitor monitor(options.run.quiet);

  Report report;
  report.title = "radiosity: transport operators compared";
  report.machine = machine_text(measure_machine());
  report.date = fmt::format("{:%Y-%m-%d}", fmt::localtime(std::time(nullptr)));
  for (const Experiment& experiment : experiments) {
    if (!wanted(options, experiment)) continue;
    report.sections.push_back(experiment.run(options, command_of(options, experiment), program, monitor));
  }
  const std::filesystem::path file = options.folder / "report.html";
  write_report(file, report);
  monitor.clear();
  if (!options.tables.empty())
    for (const ReportSection& section : report.sections) fmt::print("{}", to_text(section));
  fmt::print("wrote {}\n", file.string());
}

}  // namespace

void add_reproduce_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("reproduce", "run the experiments: tables and figures, into results/report.html");
  const auto options = std::make_shared<ReproduceOptions>();
  command->add_option("TABLE", options->tables, known_tables() + "; default: all")->option_text(" ");
  command->add_flag("--full", options->full, "the full sizes in place of the quick ones");
  command->add_option("--into", options->folder, "folder of the results; default results")
      ->option_text("FOLDER");
  command
      ->add_option("--device-results", options->device_results_file,
                   "columns of a graphics device, from radiosity bench --device gl --json FILE")
      ->option_text("FILE");
  add_run_options(*command, options->run);
  command->callback([options, &program] { run_reproduce(*options, program); });
}

}  // namespace radiosity
