#pragma once

#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace radiosity {

/// What the subcommands work with.
struct Program {
  OperatorRegistry operators;
  SolverRegistry solvers;
};

/// Each registers a subcommand that runs when the command line is parsed. `program` outlives the parser.
void add_info_command(CLI::App& app, const Program& program);
void add_form_factors_command(CLI::App& app, const Program& program);
void add_solve_command(CLI::App& app, const Program& program);
void add_render_command(CLI::App& app, const Program& program);
void add_compare_command(CLI::App& app, const Program& program);
void add_reproduce_command(CLI::App& app, const Program& program);
void add_bench_command(CLI::App& app, const Program& program);

}  // namespace radiosity
