#include "apps/interruption.hpp"
#include "apps/program.hpp"
#include "foundation/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace radiosity {
namespace {

constexpr int success = 0;
constexpr int failure = 1;
constexpr int bad_usage = 2;
constexpr int signal_offset = 128;  // the shell's convention for a process that a signal ended

int report_error(std::string message, int exit_code) {
  std::replace(message.begin(), message.end(), '\n', ' ');  // one line an error
  fmt::print(stderr, "radiosity: {}\n", message);
  return exit_code;
}

void add_commands(CLI::App& app, const Program& program) {
  app.require_subcommand(1);
  add_info_command(app, program);
  add_form_factors_command(app, program);
  add_solve_command(app, program);
  add_render_command(app, program);
  add_compare_command(app, program);
  add_reproduce_command(app, program);
  add_bench_command(app, program);
}

/// CLI11 would call an unknown command an unexpected argument.
void require_known_command(const CLI::App& app, const std::string& name) {
  std::string known;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_name() == name) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  fail<UsageError>("there is no command '{}'; the known ones are {}", name, known);
}

int run(int argc, char** argv) {
  watch_for_interruption();
  const Program program{cpu_operators(), cpu_solvers()};
  CLI::App app("Radiosity transport operators: form factors, operators, solvers and their comparison",
               "radiosity");
  add_commands(app, program);
  try {
    if (argc > 1 && argv[1][0] != '-') require_known_command(app, argv[1]);
    app.parse(argc, argv);
    return success;
  } catch (const CLI::Success& request) {  // --help
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return report_error(fmt::format("{} (see --help)", error.what()), bad_usage);
  } catch (const Cancelled& error) {
    return report_error(error.what(), received_signal() == 0 ? failure : signal_offset + received_signal());
  } catch (const UsageError& error) {
    return report_error(error.what(), bad_usage);
  } catch (const std::bad_alloc&) {
    return report_error("there is not enough memory for this many patches; use fewer (--patches, --edge)",
                        failure);
  } catch (const std::exception& error) {
    return report_error(error.what(), failure);
  }
}

}  // namespace
}  // namespace radiosity

int main(int argc, char** argv) {
  try {
    return radiosity::run(argc, argv);
  } catch (...) {  // nothing that run() does can get here, short of a failure to print
    return radiosity::failure;
  }
}
