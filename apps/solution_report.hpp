#pragma once

#include "apps/energy_balance.hpp"
#include "apps/group_summary.hpp"
#include "apps/simplification.hpp"
#include "apps/solution.hpp"
#include "experiments/certification.hpp"
#include "render/reference_comparison.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace radiosity {

/// What `radiosity solve` says of a solution.
struct SolutionReport {
  Solution solution;
  EnergyBalance energy;
  std::optional<CertificateSummary>
      certificate;                   ///< empty where F has no symmetric kernel, or with --no-certificate
  std::vector<GroupSummary> groups;  ///< mean radiosity of each group
  std::optional<ReferenceComparison> reference;  ///< with --reference
  /// With --simplify: solution, energy and certificate are of the simplified scene, groups and reference of
  /// the original.
  std::optional<SimplificationSummary> simplification;
};

/// The summary for a person, on standard output.
void print_solution(const FormFactors& form_factors, const SolutionReport& report);

/// The same as JSON.
void write_solution_json(const std::filesystem::path& file, const FormFactors& form_factors,
                         const SolutionReport& report);

}  // namespace radiosity
