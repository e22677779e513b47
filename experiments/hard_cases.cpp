#include "experiments/hard_cases.hpp"

#include "experiments/json_objects.hpp"
#include "foundation/output_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <utility>

namespace radiosity {
namespace {

using Verdict = HardCaseOutcome::Verdict;

HardCaseOutcome run_one(const HardCase& hard_case, const HardCaseSubject& subject) {
  try {
    return hard_case.run(subject);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    return {Verdict::refused, std::nullopt, error.what()};
  } catch (const std::exception& error) {
    return {Verdict::failed, std::nullopt, error.what()};
  }
}

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::failed:
      return "failed";
    case Verdict::refused:
      return "refused";
    case Verdict::reported:
      return "reported";
  }
  return {};
}

std::string cell(const HardCaseOutcome& outcome) {
  switch (outcome.verdict) {
    case Verdict::failed:
      return "FAILED";
    case Verdict::refused:
      return "refused";
    case Verdict::reported:
      return fmt::format("({:.1e})", outcome.ratio.value_or(0));
    case Verdict::passed:
      break;
  }
  return outcome.ratio ? fmt::format("{:.2g}", *outcome.ratio) : "passed";
}

ReportTable report_table(const HardCaseTable& table, const std::string& what, const std::string& command) {
  ReportTable report;
  report.caption = fmt::format(
      "Hard cases of every {}: ratio of what was measured to the threshold (at most 1 passes), or how it "
      "ended; in "
      "brackets what was measured where no threshold applies.",
      what);
  report.command = command;
  report.columns = {what};
  for (const HardCase& hard_case : table.cases) report.columns.push_back(hard_case.id);
  for (std::size_t i = 0; i < table.subjects.size(); ++i) {
    report.rows.push_back({table.subjects[i]});
    for (const HardCaseOutcome& outcome : table.outcomes[i]) report.rows.back().push_back(cell(outcome));
  }
  return report;
}

std::string verdict_word(Verdict verdict) {
  if (verdict == Verdict::refused) return " refused";
  return verdict == Verdict::failed ? " FAILED" : "";
}

/// What was said of single subjects; the same of several at once.
std::string notes_on(const HardCaseTable& table, std::size_t column) {
  std::vector<std::pair<std::string, std::string>> notes;  // subjects, and what is said of them
  for (std::size_t i = 0; i < table.subjects.size(); ++i) {
    const HardCaseOutcome& outcome = table.outcomes[i][column];
    if (outcome.note.empty()) continue;
    std::string note = verdict_word(outcome.verdict) + ": " + outcome.note;
    if (note.back() == '.') note.pop_back();
    const auto known =
        std::find_if(notes.begin(), notes.end(), [&](const auto& other) { return other.second == note; });
    if (known == notes.end())
      notes.emplace_back(table.subjects[i], note);
    else
      known->first += ", " + table.subjects[i];
  }
  std::string text;
  for (const auto& [subjects, note] : notes) text += fmt::format(" {}{}.", subjects, note);
  return text;
}

/// Titles of the cases, each with the notes on it.
void add_notes(ReportSection& section, const HardCaseTable& table) {
  for (std::size_t j = 0; j < table.cases.size(); ++j)
    section.blocks.emplace_back(
        ReportText{fmt::format("{}: {}.{}", table.cases[j].id, table.cases[j].title, notes_on(table, j))});
}

Json table_json(const HardCaseTable& table) {
  Json list = Json::array();
  for (std::size_t i = 0; i < table.subjects.size(); ++i)
    for (std::size_t j = 0; j < table.cases.size(); ++j) {
      const HardCaseOutcome& outcome = table.outcomes[i][j];
      list.push_back({{"subject", table.subjects[i]},
                      {"case", table.cases[j].id},
                      {"outcome", verdict_name(outcome.verdict)},
                      {"ratio", outcome.ratio ? Json(*outcome.ratio) : Json()},
                      {"note", outcome.note.empty() ? Json() : Json(outcome.note)}});
    }
  return list;
}

}  // namespace

HardCaseOutcome HardCaseOutcome::of_ratio(double ratio, std::string note, double slack) {
  return {ratio <= 1 + slack ? Verdict::passed : Verdict::failed, ratio, std::move(note)};
}

HardCaseOutcome HardCaseOutcome::of_failure(std::string failure) {
  if (failure.empty()) return {};
  return {Verdict::failed, std::nullopt, std::move(failure)};
}

std::size_t HardCaseTable::failures() const {
  std::size_t count = 0;
  for (const auto& row : outcomes)
    count +=
        static_cast<std::size_t>(std::count_if(row.begin(), row.end(), [](const HardCaseOutcome& outcome) {
          return outcome.verdict == Verdict::failed;
        }));
  return count;
}

HardCaseTable run_hard_cases(const std::vector<HardCase>& cases, const std::vector<std::string>& subjects,
                             const OperatorRegistry& operators, const SolverRegistry& solvers,
                             Monitor& monitor) {
  HardCaseTable table{cases, subjects, {}};
  double done = 0;
  for (const std::string& spec : subjects) {
    table.outcomes.emplace_back();
    for (const HardCase& hard_case : cases) {
      monitor.checkpoint(fmt::format("hard case {} of {}", hard_case.id, spec),
                         done++ / static_cast<double>(cases.size() * subjects.size()));
      table.outcomes.back().push_back(run_one(hard_case, {spec, operators, solvers}));
    }
  }
  return table;
}

std::vector<std::string> hard_case_operators(const OperatorRegistry& operators) {
  std::vector<std::string> specs;
  for (const OperatorEntry& entry : operators.entries()) {
    specs.push_back(entry.name);
    specs.insert(specs.end(), entry.variants.begin(), entry.variants.end());
  }
  return specs;
}

std::vector<std::string> hard_case_solvers(const SolverRegistry& solvers) {
  std::vector<std::string> specs;
  for (const SolverEntry& entry : solvers.entries()) {
    specs.push_back(entry.name);
    if (entry.name == "cg") specs.emplace_back("cg:preconditioner=quantized");
  }
  return specs;
}

ReportSection hard_case_section(const HardCaseTable& operators, const HardCaseTable& solvers,
                                const std::string& command) {
  ReportSection section{"Hard cases", {}};
  section.blocks.emplace_back(report_table(operators, "operator", command));
  add_notes(section, operators);
  section.blocks.emplace_back(report_table(solvers, "solver", command));
  add_notes(section, solvers);
  return section;
}

ReportSection hard_cases(const std::filesystem::path& folder, const std::string& command,
                         const OperatorRegistry& operators, const SolverRegistry& solvers, Monitor& monitor) {
  make_folder(folder);
  const HardCaseTable of_operators =
      run_hard_cases(operator_hard_cases(), hard_case_operators(operators), operators, solvers, monitor);
  const HardCaseTable of_solvers =
      run_hard_cases(solver_hard_cases(), hard_case_solvers(solvers), operators, solvers, monitor);
  write_json(folder / "hard_cases.json",
             {{"operators", table_json(of_operators)}, {"solvers", table_json(of_solvers)}});
  return hard_case_section(of_operators, of_solvers, command);
}

}  // namespace radiosity
