#include "experiments/first_light.hpp"
#include "foundation/error.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

FirstLightMeasurement measure(const std::vector<Index>& patches, int paths,
                              const std::vector<std::string>& operators) {
  FirstLightOptions options;
  options.patches = patches;
  options.reference_paths = paths;
  options.operators = operators;
  SilentMonitor monitor;
  return measure_first_light(options, cpu_operators(), cpu_solvers(), monitor);
}

/// Within 1 % of the referee, and the referee sure of it.
bool within_one_percent(const ReferenceComparison& difference) {
  return std::abs(difference.mean_difference) + 4 * difference.mean_difference_standard_error < 0.01;
}

TEST(FirstLight, RadiosityAgreesWithPathTracing) {
  // The closed Cornell box at about 3300 patches. One-ray form factors are the broken variant: they must
  // fail.
  const FirstLightMeasurement measurement = measure({3300}, 256, {"dense:f32"});
  const FirstLightSize& size = measurement.sizes.front();
  EXPECT_NEAR(static_cast<double>(size.mesh->patch_count()), 3300, 300);
  EXPECT_TRUE(within_one_percent(size.accurate.difference)) << size.accurate.difference.mean_difference;
  EXPECT_FALSE(within_one_percent(size.one_ray.difference)) << size.one_ray.difference.mean_difference;
  EXPECT_LT(size.accurate.quality.row_sum_rms, 1e-10);
  EXPECT_LT(size.raw_row_sum_rms, 2e-3);
  EXPECT_EQ(size.referee.leaks, 0U);
}

TEST(FirstLight, DifferenceFromPathTracingShrinksWithPatches) {
  const FirstLightMeasurement measurement = measure({80, 320}, 4096, {"dense"});
  const ReferenceComparison& coarse = measurement.sizes[0].accurate.difference;
  const ReferenceComparison& fine = measurement.sizes[1].accurate.difference;
  EXPECT_GT(coarse.rms_difference, 4 * coarse.rms_difference_standard_error);  // there is a difference to see
  EXPECT_LT(fine.rms_difference + 2 * fine.rms_difference_standard_error, coarse.rms_difference);
}

TEST(FirstLight, WritesFilesAndASection) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "results";
  FirstLightOptions options;
  options.patches = {70, 120};
  options.reference_paths = 64;
  options.operators = {"dense", "csr"};
  options.picture_size = 60;
  SilentMonitor monitor;
  const ReportSection section = first_light(folder, "radiosity reproduce first-light", options,
                                            cpu_operators(), cpu_solvers(), monitor);

  std::ifstream csv(folder / "first_light.csv");
  std::string line;
  int lines = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 9) << line;
    ++lines;
  }
  EXPECT_EQ(lines, 1 + 2 * 3);  // heading; two operators and one-ray at each size

  std::ifstream json_file(folder / "first_light.json");
  const auto json = nlohmann::json::parse(json_file);
  ASSERT_EQ(json["sizes"].size(), 2U);
  EXPECT_EQ(json["sizes"][1]["operators"][1]["operator"], "csr");
  EXPECT_TRUE(json["sizes"][0]["accurate"]["difference_from_referee"]["mean"].is_number());

  int tables = 0;
  int figures = 0;
  for (const ReportBlock& block : section.blocks) {
    if (const auto* table = std::get_if<ReportTable>(&block)) {
      EXPECT_EQ(table->command, "radiosity reproduce first-light");
      ++tables;
    }
    figures += std::holds_alternative<ReportFigure>(block) ? 1 : 0;
  }
  EXPECT_EQ(tables, 3);
  EXPECT_EQ(figures, 4);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  EXPECT_TRUE(fs::exists(folder / "first_light_flat.png"));
  EXPECT_TRUE(fs::exists(folder / "first_light_smooth.png"));
}

TEST(FirstLight, RefusesAFolderThatCannotBe) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("file", "in the way");
  SilentMonitor monitor;
  EXPECT_THROW(first_light(file / "results", "", {}, cpu_operators(), cpu_solvers(), monitor), Error);
  EXPECT_THROW(measure({}, 64, {"dense"}), UsageError);
}

}  // namespace
}  // namespace radiosity
