#include "experiments/dxt_radiosity/dxt_errors.hpp"
#include "experiments/dxt_radiosity/dxt_errors_findings.hpp"
#include "experiments/dxt_radiosity/improvement_steps.hpp"
#include "foundation/error.hpp"
#include "tests/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace radiosity {
namespace {

DxtErrorsOptions small_dxt_study() {
  DxtErrorsOptions options;
  options.patches = 100;
  options.lights = {.area = 1, .point = 1, .patch = 1};
  options.exact_parts = {0, 0.04, 0.1};
  options.bounces = {1, 3};
  return options;
}

const DxtErrors& small_errors() {
  static const DxtErrors errors = [] {
    SilentMonitor monitor;
    return measure_dxt_errors(small_dxt_study(), cpu_operators(), cpu_solvers(), monitor);
  }();
  return errors;
}

void expect_finite_numbers(const nlohmann::json& value, const std::string& path) {
  EXPECT_TRUE(!value.is_number() || std::isfinite(value.get<double>())) << path;
  if (value.is_structured())
    for (const auto& [key, member] : value.items())
      expect_finite_numbers(member, fmt::format("{}/{}", path, key));
}

TEST(Histogram, CountsEveryNumberOnce) {
  Histogram histogram(0, 4, 4);
  for (const double number : {-1.0, 0.0, 0.5, 1.0, 3.9, 4.0, 7.0, std::nan("")}) histogram.add(number);
  EXPECT_EQ(histogram.counts, (std::vector<std::uint64_t>{2, 1, 0, 3}));
  EXPECT_EQ(histogram.below, 2);
  EXPECT_EQ(histogram.total(), 8);
  EXPECT_NEAR(histogram.centre(1), 1.5, 1e-15);
}

TEST(EntryErrors, OfAMatrixThatIsKeptWholeAreNone) {
  ColourMatrix matrix(4, 4);
  matrix << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15;
  const std::vector<ColourMatrix> matrices(3, matrix);
  const auto in_place = [](std::span<const CodeMatrix>) { return std::vector<Index>{0, 1, 2, 3}; };
  EXPECT_EQ(entry_errors(matrices, compress_colours(matrices, {.exact = 1}, in_place)).total, 0);
  EXPECT_EQ(largest_compressed_entry(matrices, 1), 0);
  EXPECT_EQ(largest_compressed_entry(matrices, 0.5), 13);
  // Black texels in place of all: 0 entries are right, the others err by themselves.
  const CompressedColours black(ColourTexture(4, 4, 3, {}),
                                std::vector<ExactRows>(3, ExactRows(4, std::vector<ExactRows::Row>(4))),
                                {0, 1, 2, 3});
  const EntryErrors errors = entry_errors(matrices, black);
  EXPECT_EQ(errors.total, 3 * 120);
  EXPECT_EQ(errors.largest, 15);
  EXPECT_EQ(errors.average, 7.5);
}

TEST(DxtErrors, HistogramsCountEveryEntry) {
  const auto n = static_cast<std::uint64_t>(small_errors().patches);
  const EntryHistograms& histograms = small_errors().histograms;
  EXPECT_EQ(histograms.factors.total(), n * n);
  EXPECT_EQ(histograms.logarithms.total(), n * n);
  EXPECT_EQ(histograms.normalized.total(), 3 * n * n);
  EXPECT_EQ(histograms.codes.total(), 3 * n * n);
  EXPECT_EQ(histograms.codes.below, 0);
  EXPECT_GT(histograms.codes.counts[255], 0) << "the largest of each channel";
  EXPECT_GT(histograms.small, 0.3);
}

TEST(DxtErrors, FallWithTheExactPart) {
  const std::vector<ExactPartRow>& rows = small_errors().exact_parts;
  ASSERT_EQ(rows.size(), 3);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_LT(rows[i].without_order, rows[i - 1].without_order);
    EXPECT_LT(rows[i].ordered, rows[i - 1].ordered);
    EXPECT_LT(rows[i].filled, rows[i - 1].filled);
  }
  EXPECT_EQ(rows[1].ordered, small_errors().reordering("face", "both").errors.total);
}

TEST(DxtErrors, ReorderingHelpsAndNothingErrsByMoreThanTheLargestCompressed) {
  const DxtErrors& errors = small_errors();
  EXPECT_LT(errors.reordering("random", "both").errors.total,
            0.8 * errors.reordering("random", "none").errors.total);
  for (const ReorderingRow& row : errors.reorderings)
    EXPECT_LE(row.errors.largest, errors.largest_compressed * (1 + 1e-6));
  EXPECT_THROW(errors.reordering("face", "2opt"), Error);
}

// As measured at first: what changes these changes what the report says.
TEST(DxtErrors, TableOfOrdersIsAsBefore) {
  const DxtErrors& errors = small_errors();
  EXPECT_NEAR(errors.reordering("random", "none").errors.total, 184.09, 0.01);
  EXPECT_NEAR(errors.reordering("random", "both").errors.total, 122.53, 0.01);
  EXPECT_NEAR(errors.reordering("face", "none").errors.total, 114.52, 0.01);
  EXPECT_NEAR(errors.reordering("face", "morton").errors.total, 113.66, 0.01);
}

TEST(DxtErrors, EachStepIsMeasuredAndTheImprovedVariantIsBetterAtTheSameBytes) {
  const DxtErrors& errors = small_errors();
  ASSERT_EQ(errors.steps.size(), std::size(improvement_variants));
  const OperatorAnswer& document = errors.step(document_variant).answer;
  const OperatorAnswer& improved = errors.step(improved_variant).answer;
  ASSERT_TRUE(document.errors && improved.errors);
  EXPECT_LE(improved.bytes, document.bytes);
  EXPECT_LT(improved.errors->radiosity, document.errors->radiosity);
  EXPECT_LT(errors.step("dense:f16").answer.errors->radiosity, 1e-3);
}

TEST(DxtErrors, BouncesAreComparedWithAsManyBounces) {
  const std::vector<BouncesRow>& rows = small_errors().bounces;
  ASSERT_EQ(rows.size(), 6) << "1, 3 and all bounces of two variants";
  for (const BouncesRow& row : rows) {
    ASSERT_TRUE(row.iterated);
    EXPECT_EQ(row.bounces == 1L, row.summed.radiosity == row.iterated->radiosity);
    EXPECT_GT(row.summed.radiosity, 0);
    EXPECT_LT(row.summed.radiosity, 0.5) << row.variant;
  }
}

TEST(DxtErrors, FilesAndSectionHoldWhatWasMeasured) {
  const TemporaryFolder temporary;
  write_dxt_errors(temporary.path(), small_errors());
  std::ifstream file(temporary.path() / "dxt_errors.json");
  const nlohmann::json written = nlohmann::json::parse(file);
  for (const char* key : {"scene", "patches", "histograms", "reorderings", "largest_compressed",
                          "exact_parts", "bounces", "steps"})
    EXPECT_TRUE(written.contains(key)) << key;
  expect_finite_numbers(written, "");
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "dxt_errors.csv"));
  const ReportSection section = dxt_errors_section(small_errors(), small_dxt_study(), "command");
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  const std::string finding = published_table_finding(small_errors());
  EXPECT_NE(finding.find("3.68e+07, 2.32e+07, 1.60e+07"), std::string::npos) << finding;
}

}  // namespace
}  // namespace radiosity
