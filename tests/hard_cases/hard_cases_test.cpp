// Every registered operator and solver through every hard case, and broken ones that must fail.

#include "experiments/hard_cases.hpp"
#include "foundation/error.hpp"
#include "operators/kernel_operator.hpp"
#include "solvers/stepped_solver.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace radiosity {
namespace {

using Verdict = HardCaseOutcome::Verdict;

std::string failures_of(const HardCaseTable& table) {
  std::string text;
  for (std::size_t i = 0; i < table.subjects.size(); ++i)
    for (std::size_t j = 0; j < table.cases.size(); ++j)
      if (table.outcomes[i][j].verdict == Verdict::failed)
        text += fmt::format("{} fails {} ({}): {}\n", table.subjects[i], table.cases[j].id,
                            table.outcomes[i][j].ratio.value_or(0), table.outcomes[i][j].note);
  return text;
}

HardCaseTable run(const std::vector<HardCase>& cases, const std::vector<std::string>& subjects,
                  const OperatorRegistry& operators = cpu_operators(),
                  const SolverRegistry& solvers = cpu_solvers()) {
  SilentMonitor monitor;
  return run_hard_cases(cases, subjects, operators, solvers, monitor);
}

// One test for all operators and one for all solvers: the scenes are traced once a process.
TEST(OperatorHardCases, AreMetOrRefused) {
  const HardCaseTable table = run(operator_hard_cases(), hard_case_operators(cpu_operators()));
  EXPECT_EQ(failures_of(table), "");
  for (const auto& row : table.outcomes)
    for (const HardCaseOutcome& outcome : row)
      EXPECT_TRUE(outcome.verdict != Verdict::refused || !outcome.note.empty());
}

TEST(SolverHardCases, AreMetOrRefused) {
  const HardCaseTable table = run(solver_hard_cases(), hard_case_solvers(cpu_solvers()));
  EXPECT_EQ(failures_of(table), "");
  // Only stationary iterations may say that their budget does not suffice.
  for (std::size_t i = 0; i < table.subjects.size(); ++i)
    for (std::size_t j = 0; j < table.cases.size(); ++j) {
      const HardCaseOutcome& outcome = table.outcomes[i][j];
      if (outcome.verdict != Verdict::refused) continue;
      EXPECT_TRUE(table.subjects[i] == "neumann" || table.subjects[i] == "gauss-seidel")
          << table.subjects[i] << " " << table.cases[j].id << ": " << outcome.note;
      EXPECT_NE(outcome.note.find("budget"), std::string::npos) << outcome.note;
    }
}

/// The true kernel with one fault.
class FaultyKernel final : public KernelOperator {
 public:
  FaultyKernel(const FormFactors& form_factors, std::string fault)
      : KernelOperator(form_factors), kernel_(form_factors.kernel), fault_(std::move(fault)) {}
  ByteCount bytes() const override { return {}; }
  std::string describe() const override { return "faulty:fault=" + fault_; }
  Certificate certificate() const override {
    if (fault_ == "overstates") return {1e-3, 1e-20, "proved"};
    return {std::nullopt, 1e-12, "proved"};
  }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    multiply(*kernel_, X, Y);
    // A closure that leaks: every patch gets a share of the light of all, whether it sees them or not.
    if (fault_ == "leaks") Y += 1e-9 * root_area() * (root_area().transpose() * X);
    if (fault_ == "amplifies") Y *= 1.01;
    if (fault_ == "forgets") Y *= 1 + 1e-13 * static_cast<double>(usage().products);
    if (fault_ == "rounds") Y = Y.cast<float>().cast<double>();
  }

 private:
  std::shared_ptr<const SymmetricTiles<double>> kernel_;
  std::string fault_;
};

OperatorRegistry with_faulty_operator() {
  OperatorRegistry operators = cpu_operators();
  operators.add({.name = "faulty",
                 .summary = "the true kernel with one fault",
                 .defaults = "faulty",
                 .make = [](Spec& spec, const FormFactors& form_factors) -> std::unique_ptr<LinearOperator> {
                   return std::make_unique<FaultyKernel>(form_factors, spec.text("fault", "none"));
                 }});
  return operators;
}

Verdict verdict_of(const HardCaseTable& table, const std::string& id) {
  for (std::size_t j = 0; j < table.cases.size(); ++j)
    if (table.cases[j].id == id) return table.outcomes[0][j].verdict;
  ADD_FAILURE() << "there is no case " << id;
  return Verdict::passed;
}

TEST(BrokenOperators, FailTheCaseThatIsForThem) {
  const OperatorRegistry operators = with_faulty_operator();
  const auto outcome = [&](const std::string& fault, const std::string& id) {
    std::vector<HardCase> cases = operator_hard_cases();
    std::erase_if(cases, [&](const HardCase& hard_case) { return hard_case.id != id; });
    return verdict_of(run(cases, {"faulty:fault=" + fault}, operators), id);
  };
  for (const char* id : {"G7", "G8", "O1", "O3", "O4", "O5", "K1"})
    EXPECT_NE(outcome("none", id), Verdict::failed) << id;
  EXPECT_EQ(outcome("leaks", "G7"), Verdict::failed);
  EXPECT_EQ(outcome("leaks", "G8"), Verdict::failed);
  EXPECT_EQ(outcome("rounds", "O1"), Verdict::failed);
  EXPECT_EQ(outcome("forgets", "O3"), Verdict::failed);
  EXPECT_EQ(outcome("overstates", "O4"), Verdict::failed);
  EXPECT_EQ(outcome("amplifies", "R2"), Verdict::refused);  // above 1: Neumann says so
}

/// Stops a given number of bounces too early, or answers where there is no answer.
class HastySolver final : public Solver {
 public:
  explicit HastySolver(const SolverProblem& problem) : transport_(problem.transport) {}
  void start(const Field& emission) override {
    emission_ = emission;
    radiosity_ = emission;
    steps_ = 0;
  }
  void step() override {
    Field image(radiosity_.rows(), radiosity_.cols());
    transport_.apply(radiosity_, image);
    radiosity_ = emission_ + image;
    ++steps_;
  }
  bool converged() const override { return steps_ >= 5; }
  const Field& radiosity() const override { return radiosity_; }
  double residual() const override { return 0; }
  int products() const override { return steps_; }
  std::string describe() const override { return "hasty"; }

 private:
  const LinearOperator& transport_;
  Field emission_;
  Field radiosity_;
  int steps_ = 0;
};

TEST(BrokenSolvers, FailWhatChecksTheirAnswers) {
  SolverRegistry solvers = cpu_solvers();
  solvers.add(
      {"hasty", "five bounces", "hasty", [](Spec&, const SolverProblem& problem) -> std::unique_ptr<Solver> {
         return std::make_unique<HastySolver>(problem);
       }});
  const HardCaseTable table = run(solver_hard_cases(), {"hasty"}, cpu_operators(), solvers);
  for (const char* id : {"R1", "R4", "E1", "E2", "S1"})
    EXPECT_EQ(verdict_of(table, id), Verdict::failed) << id;
}

TEST(HardCases, GrowByThemselvesAndFillAReport) {
  EXPECT_EQ(hard_case_operators(with_faulty_operator()).size(),
            hard_case_operators(cpu_operators()).size() + 1);
  const HardCase thrower{"T", "throws", [](const HardCaseSubject& subject) -> HardCaseOutcome {
                           if (subject.spec == "dense") fail("no thank you");
                           throw std::runtime_error("unexpected");
                         }};
  const HardCase reporter{"N", "reports", [](const HardCaseSubject&) {
                            return HardCaseOutcome{Verdict::reported, 0.25, "a quarter"};
                          }};
  const HardCaseTable table = run({thrower, reporter}, {"dense", "csr"});
  EXPECT_EQ(table.outcomes[0][0].verdict, Verdict::refused);
  EXPECT_EQ(table.outcomes[1][0].verdict, Verdict::failed);
  EXPECT_EQ(table.failures(), 1U);
  const std::string text = to_text(hard_case_section(table, table, "radiosity reproduce hard-cases"));
  for (const char* part : {"refused", "FAILED", "(2.5e-01)", "no thank you", "dense, csr: a quarter"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

}  // namespace
}  // namespace radiosity
