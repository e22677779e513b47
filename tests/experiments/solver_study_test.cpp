#include "experiments/solver_study.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace radiosity {
namespace {

SolverStudyOptions small_study() {
  SolverStudyOptions options;
  options.rooms = {1, 3};
  options.reflectances = {0.5, 0.99, 0.9999};
  options.patches_a_room = 80;
  return options;
}

const std::vector<SolverRun>& small_runs() {
  static const std::vector<SolverRun> runs = [] {
    SilentMonitor monitor;
    return measure_solvers(small_study(), cpu_operators(), cpu_solvers(), monitor);
  }();
  return runs;
}

// S1: products of conjugate gradients, plain and corrected, over reflectance and rooms.
TEST(SolverStudy, ConjugateGradientsNeedAFewProductsARoom) {
  int plain = 0, corrected = 0;
  for (const SolverRun& run : small_runs()) {
    if (run.solver == "cg") {
      ++plain;
      ASSERT_TRUE(run.products) << run.refusal;
      EXPECT_LE(*run.products, 20 + 4 * run.rooms) << run.reflectance;
    }
    if (run.solver.starts_with("cg:preconditioner=")) {
      ++corrected;
      ASSERT_TRUE(run.products) << run.refusal;
      EXPECT_LE(*run.products, 8) << run.reflectance;
    }
  }
  EXPECT_EQ(plain, 6);
  EXPECT_EQ(corrected, 6);
}

TEST(SolverStudy, EverySolverAnswersOrSaysWhyNot) {
  EXPECT_EQ(small_runs().size(), 2 * 3 * (cpu_solvers().entries().size() + 1));
  bool refused = false;
  for (const SolverRun& run : small_runs()) {
    EXPECT_NE(run.products.has_value(), !run.refusal.empty()) << run.solver;
    refused = refused || !run.refusal.empty();
    if (run.solver == "neumann" && run.reflectance == 0.9999) {
      EXPECT_NE(run.refusal.find("budget"), std::string::npos) << run.refusal;
    }
  }
  EXPECT_TRUE(refused) << "stationary solvers cannot do 0.9999 in 3000 products";
}

TEST(SolverStudy, WritesFilesAndASection) {
  const TemporaryFolder temporary;
  const auto& folder = temporary.path();
  SolverStudyOptions options = small_study();
  options.rooms = {1};
  options.reflectances = {0.5, 0.9};
  SilentMonitor monitor;
  const ReportSection section =
      solver_study(folder, "radiosity reproduce solvers", options, cpu_operators(), cpu_solvers(), monitor);
  for (const char* file : {"solvers.json", "solvers.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  std::ifstream csv(folder / "solvers.csv");
  std::string line;
  std::size_t lines = 0;
  while (std::getline(csv, line)) ++lines;
  EXPECT_EQ(lines, 1 + 2 * (cpu_solvers().entries().size() + 1));
  Report report;
  report.sections.push_back(section);
  EXPECT_NE(to_html(report).find("cg:preconditioner="), std::string::npos);
}

}  // namespace
}  // namespace radiosity
