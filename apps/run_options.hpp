#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace radiosity {

/// What every subcommand takes.
struct RunOptions {
  int threads = 0;  ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  bool quiet = false;
  std::string device = "cpu";
};

/// What `options` has for the device is the default.
void add_run_options(CLI::App& command, RunOptions& options);

}  // namespace radiosity
