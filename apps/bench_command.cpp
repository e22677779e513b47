#include "apps/device_choice.hpp"
#include "apps/number_ranges.hpp"
#include "apps/output_check.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/scene_options.hpp"
#include "apps/terminal_monitor.hpp"
#include "experiments/apply_benchmark.hpp"
#include "experiments/device/device_benchmark.hpp"
#include "experiments/form_factor_benchmark.hpp"
#include "experiments/low_rank_benchmark.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "gpu/upload.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {
namespace {

struct BenchOptions {
  std::vector<std::string> names;
  std::string scene = "cornell-box-closed";
  std::optional<Index> patches;
  std::vector<std::string> operators;
  std::vector<std::string> sizes;
  bool full = false;
  std::optional<double> seconds;
  std::filesystem::path json_file;
  RunOptions run;
};

struct Benchmark {
  const char* name;
  void (*run)(const BenchOptions& options, const Program& program);
};

/// What is not O(n^3) to build of what runs on a device.
std::vector<std::string> quick_device_operators(const OperatorRegistry& operators) {
  std::vector<std::string> specs;
  for (const std::string& text : uploadable_specs()) {
    const std::string name = Spec::parse(text).name();
    const auto& entries = operators.entries();
    if (std::any_of(entries.begin(), entries.end(),
                    [&](const OperatorEntry& entry) { return entry.name == name && !entry.cubic; }))
      specs.push_back(text);
  }
  return specs;
}

void bench_apply(const BenchOptions& options, const Program& cpu_program) {
  ApplyBenchmarkOptions sizes;
  sizes.size = options.patches.value_or(sizes.size);
  sizes.operators = options.operators;
  if (options.run.device == "gl" && sizes.operators.empty())
    sizes.operators = quick_device_operators(cpu_program.operators);
  const Program program = on_device(cpu_program, options.run, sizes.operators);
  if (options.run.threads > 0) sizes.threads = {options.run.threads};
  print_apply_benchmark(benchmark_apply(program.operators, sizes), std::cout);
}

void bench_form_factors(const BenchOptions& options, const Program&) {
  require_cpu(options.run, "bench form-factors");
  SceneOptions scene;
  scene.scene = options.scene;
  scene.patches = options.patches.value_or(13000);
  FormFactorOptions form_factors;
  form_factors.seed = options.run.seed;
  TerminalMonitor monitor(options.run.quiet);
  const FormFactorBenchmark result = benchmark_form_factors(open_mesh(scene), form_factors, monitor);
  monitor.clear();
  std::cout << form_factor_benchmark_text(result) << std::flush;
}

void bench_low_rank(const BenchOptions& options, const Program&) {
  require_cpu(options.run, "bench low-rank");
  LowRankBenchmarkOptions sizes;
  if (!options.sizes.empty()) sizes.sizes.clear();
  for (const std::string& size : options.sizes) sizes.sizes.push_back(LowRankSize::parse(size));
  if (options.run.threads > 0) sizes.threads = {options.run.threads};
  print_low_rank_benchmark(benchmark_low_rank(sizes), std::cout);
}

/// All that is wanted of a device, for `radiosity reproduce --device-results`.
void bench_device(const BenchOptions& options, const Program& cpu_program) {
  if (options.run.device != "gl")
    fail<UsageError>("bench device measures a graphics device: say --device gl");
  require_writable(options.json_file);
  DeviceBenchmarkOptions sizes =
      options.full ? DeviceBenchmarkOptions::full_sizes() : DeviceBenchmarkOptions();
  if (!options.sizes.empty()) {
    sizes.sizes.clear();
    sizes.large_sizes.clear();
    sizes.costs.factors = LowRankSize::parse(options.sizes.front());
  }
  for (const std::string& size : options.sizes) sizes.sizes.push_back(LowRankSize::parse(size));
  if (options.patches) {
    sizes.patches = {*options.patches};
    sizes.patches_over_bounces = sizes.costs.patches = *options.patches;
  }
  if (options.seconds) sizes.seconds = sizes.costs.seconds = *options.seconds;
  sizes.seed = sizes.costs.seed = options.run.seed;
  TerminalMonitor monitor(options.run.quiet);
  const DeviceResults results =
      benchmark_device(open_device(options.run), sizes, cpu_program.operators, monitor);
  if (!options.json_file.empty()) write_device_results(options.json_file, results);
  monitor.clear();
  std::cout << to_text(device_section(results, "radiosity bench device --device gl")) << std::flush;
}

constexpr std::array<Benchmark, 4> benchmarks = {{{"apply", bench_apply},
                                                  {"form-factors", bench_form_factors},
                                                  {"low-rank", bench_low_rank},
                                                  {"device", bench_device}}};

/// Without names: all, or what a device is measured by.
bool bench_wanted(const BenchOptions& options, const std::string& name) {
  if (options.names.empty()) return (name == "device") == (options.run.device == "gl");
  return std::find(options.names.begin(), options.names.end(), name) != options.names.end();
}

void run_bench(const BenchOptions& options, const Program& program) {
  const ThreadLimit limit(options.run.threads);
  for (const std::string& name : options.names)
    if (std::none_of(benchmarks.begin(), benchmarks.end(),
                     [&](const Benchmark& known) { return name == known.name; }))
      fail<UsageError>(
          "there is no benchmark '{}'; the known ones are apply, form-factors, low-rank and "
          "device",
          name);
  for (const Benchmark& benchmark : benchmarks)
    if (bench_wanted(options, benchmark.name)) benchmark.run(options, program);
}

}  // namespace

void add_bench_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("bench", "speed of products and of form factors, against the machine's limits");
  const auto options = std::make_shared<BenchOptions>();
  command
      ->add_option(
          "NAME", options->names,
          "apply, form-factors, low-rank or device; default: device with --device gl, else the others")
      ->option_text(" ");
  command->add_option("--scene", options->scene, "for form-factors; default cornell-box-closed")
      ->option_text("SCENE");
  command
      ->add_option(
          "--patches", options->patches,
          "size of the matrix; default 16384 for apply, 13000 for form-factors, 400 to 2048 for device")
      ->check(integer_between(1, 10'000'000))
      ->option_text("N");
  command->add_option("--operators", options->operators, "for apply; default: all")
      ->expected(1, -1)
      ->option_text("SPEC ...");
  command
      ->add_option("--sizes", options->sizes, "n x k for low-rank and device; default 221184x216 55296x864")
      ->expected(1, -1)
      ->option_text("NxK ...");
  command->add_flag("--full", options->full, "for device: the documents' sizes in place of the quick ones");
  command
      ->add_option("--seconds", options->seconds,
                   "for device: of each time; default 0.05, or 0.5 with --full")
      ->check(number_between(0, 3600, false))
      ->option_text("S");
  command
      ->add_option("--json", options->json_file,
                   "for device: write what radiosity reproduce --device-results reads")
      ->option_text("FILE");
  add_run_options(*command, options->run);
  command->callback([options, &program] { run_bench(*options, program); });
}

}  // namespace radiosity
