#pragma once

#include "experiments/lights.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The two-sided 2MSC, F P + P F - P F P, beside the one-sided F P with V sparse, at equal bytes and at equal
/// time of a product.
struct EqualCostOptions {
  std::vector<std::string> scenes = {"cube", "cornell-box-closed", "clutter"};
  Index patches = 800;
  std::vector<Index> ranks = {50, 100,
                              200};  ///< of the two-sided; the one-sided goes from half to four times
  LightCounts lights = {.area = 12};
  std::uint64_t seed = 1;
};

/// An operator of k patches.
struct CostedOperator {
  Index k = 0;
  double bytes = 0;
  double seconds = 0;  ///< of a product, the fastest
  double error = 0;    ///< mean in B
};

/// What the one-sided operator of the same cost has; its k is interpolated and need not be whole.
struct EqualCost {
  double k = 0;
  double error = 0;
};

struct EqualCostRow {
  std::string scene;
  Index patches = 0;
  CostedOperator two_sided;
  std::optional<EqualCost> at_equal_rank, at_equal_bytes, at_equal_time;  ///< empty beyond what was measured
};

/// The k of the line bytes (or seconds) = a + b k through the one-sided operators where it costs as much, and
/// its error, interpolated between logarithms; empty outside of the measured k. `one_sided`: rising k, two at
/// least.
std::optional<EqualCost> at_equal_cost(const std::vector<CostedOperator>& one_sided,
                                       double CostedOperator::*cost, double wanted);

std::vector<EqualCostRow> measure_equal_cost(const EqualCostOptions& options,
                                             const OperatorRegistry& operators, const SolverRegistry& solvers,
                                             Monitor& monitor);

/// Measures, writes low_rank_sides.json into `folder`, returns the section.
ReportSection equal_cost(const std::filesystem::path& folder, const std::string& command,
                         const EqualCostOptions& options, const OperatorRegistry& operators,
                         const SolverRegistry& solvers, Monitor& monitor);

}  // namespace radiosity
