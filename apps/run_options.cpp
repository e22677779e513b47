#include "apps/run_options.hpp"

#include "apps/number_ranges.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <limits>

namespace radiosity {

void add_run_options(CLI::App& command, RunOptions& options) {
  command.add_option("--threads", options.threads, "number of threads; default: all of the machine's")
      ->check(integer_between(1, 4096))
      ->option_text("N");
  command.add_option("--seed", options.seed, "of everything random; default 1")
      ->check(integer_between(0, std::numeric_limits<std::int64_t>::max()))
      ->option_text("N");
  command.add_flag("--quiet", options.quiet, "no progress bar and no notes");
  command
      .add_option(
          "--device", options.device,
          fmt::format("where operators run: cpu, or gl (OpenGL 4.3 or later); default {}", options.device))
      ->option_text("cpu|gl");
}

}  // namespace radiosity
