#pragma once

#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// How one operator or solver came out of one hard case.
struct HardCaseOutcome {
  enum class Verdict {
    passed,    ///< ratio is of what was measured to the threshold, at most 1
    failed,    ///< the note says why
    refused,   ///< with the sentence in the note, and without a wrong answer
    reported,  ///< no threshold applies: ratio is what was measured
  };
  Verdict verdict = Verdict::passed;
  std::optional<double> ratio;
  std::string note;

  /// Passed if the ratio is at most 1 (with `slack` for what is measured itself), else failed.
  static HardCaseOutcome of_ratio(double ratio, std::string note = {}, double slack = 1e-6);
  /// Failed with its text, or passed where there is none.
  static HardCaseOutcome of_failure(std::string failure);
};

/// What a hard case is asked of: an operator by its spec, or a solver by its spec with the true operator.
struct HardCaseSubject {
  std::string spec;
  const OperatorRegistry& operators;
  const SolverRegistry& solvers;
};

struct HardCase {
  std::string id;     ///< of the list of hard cases: "O1"
  std::string title;  ///< what passes, in a line
  std::function<HardCaseOutcome(const HardCaseSubject&)> run;
};

/// The cases that every operator meets, and those that every solver meets. Scenes are shared between calls.
std::vector<HardCase> operator_hard_cases();
std::vector<HardCase> solver_hard_cases();

struct HardCaseTable {
  std::vector<HardCase> cases;
  std::vector<std::string> subjects;                   ///< specs
  std::vector<std::vector<HardCaseOutcome>> outcomes;  ///< subjects x cases

  std::size_t failures() const;
};

/// Runs each subject through each case. An Error that a case does not expect is a refusal; any other
/// exception a failure.
HardCaseTable run_hard_cases(const std::vector<HardCase>& cases, const std::vector<std::string>& subjects,
                             const OperatorRegistry& operators, const SolverRegistry& solvers,
                             Monitor& monitor);

/// Every registered operator at its defaults and in its variants; every registered solver at its defaults,
/// and cg corrected by a compressed operator.
std::vector<std::string> hard_case_operators(const OperatorRegistry& operators);
std::vector<std::string> hard_case_solvers(const SolverRegistry& solvers);

ReportSection hard_case_section(const HardCaseTable& operators, const HardCaseTable& solvers,
                                const std::string& command);

/// Runs both tables, writes hard_cases.json into `folder` (made if it is missing), returns the section.
ReportSection hard_cases(const std::filesystem::path& folder, const std::string& command,
                         const OperatorRegistry& operators, const SolverRegistry& solvers, Monitor& monitor);

}  // namespace radiosity
