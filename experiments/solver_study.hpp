#pragma once

#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

struct SolverStudyOptions {
  std::vector<int> rooms = {1, 2, 5, 10};  ///< of a chain, joined by doors 0.3 wide
  std::vector<double> reflectances = {0.5, 0.9, 0.99, 0.999, 0.9999};
  Index patches_a_room = 150;
  double tolerance = 1e-6;
  int max_products = 3000;
  std::uint64_t seed = 1;
};

/// One solver on one problem.
struct SolverRun {
  int rooms = 0;
  Index patches = 0;
  double reflectance = 0;
  std::string solver;           ///< its spec
  std::optional<int> products;  ///< with the true operator; empty: refused
  double seconds = 0;           ///< of the solution, with what the solver prepares for its first light
  std::string refusal;          ///< the sentence; empty if it solved
};

/// Every registered solver at its defaults, and cg corrected by a compressed operator, over reflectances and
/// chains of rooms, all with the dense operator in double precision, lit by the scene's own light.
std::vector<SolverRun> measure_solvers(const SolverStudyOptions& options, const OperatorRegistry& operators,
                                       const SolverRegistry& solvers, Monitor& monitor);

/// The runs as tables and a plot.
ReportSection solver_section(const std::vector<SolverRun>& runs, const SolverStudyOptions& options,
                             const std::string& command);

/// Measures, writes solvers.json and solvers.csv into `folder` (made if it is missing), returns the section.
ReportSection solver_study(const std::filesystem::path& folder, const std::string& command,
                           const SolverStudyOptions& options, const OperatorRegistry& operators,
                           const SolverRegistry& solvers, Monitor& monitor);

}  // namespace radiosity
