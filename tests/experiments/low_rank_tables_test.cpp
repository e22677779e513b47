#include "experiments/low_rank_radiosity/cube_meshes.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/low_rank_radiosity/published_tables.hpp"
#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace radiosity {
namespace {

LowRankTablesOptions small_tables() {
  LowRankTablesOptions options;
  options.sizes = {{216, 54}, {216, 216}, {864, 54}, {3456, 24}};
  options.large_sizes = {{432, 48}, {1769472, 216}};
  options.largest_timed = 1e5;
  options.largest_computed = 5e4;
  options.largest_dense_error = 216;
  options.lights = {.area = 3};
  options.seconds = 0.01;
  options.streamed_seconds = 0.01;
  options.stream_bytes = std::size_t{1} << 20;
  options.cached_bytes = 300000;
  return options;
}

const LowRankTables& small_results() {
  static const LowRankTables tables = [] {
    SilentMonitor monitor;
    return measure_low_rank_tables(small_tables(), monitor);
  }();
  return tables;
}

const ReportTable& table_of(const ReportSection& section, const std::string& caption) {
  for (const ReportBlock& block : section.blocks)
    if (const auto* table = std::get_if<ReportTable>(&block))
      if (table->caption.starts_with(caption)) return *table;
  throw Error("there is no table " + caption);
}

TEST(LowRankTables, AnElementForEachPatchGivesTheDenseSolution) {
  const LowRankTableRow& row = small_results().rows[1];
  ASSERT_TRUE(row.errors);
  EXPECT_LE(row.errors->largest_difference, 1e-6);
  EXPECT_GT(row.errors->largest_difference, 0) << "Y is in float32, the dense solution in double";
  ASSERT_TRUE(small_results().rows[0].errors);
  EXPECT_GT(small_results().rows[0].errors->radiosity_mean, 1e-3) << "fewer patches than elements err";
}

TEST(LowRankTables, MeasuresWhatIsAskedFor) {
  const std::vector<LowRankTableRow>& rows = small_results().rows;
  ASSERT_EQ(rows.size(), 4);
  EXPECT_TRUE(rows[2].computed);
  EXPECT_FALSE(rows[2].errors) << "864 elements are more than are solved densely";
  EXPECT_FALSE(rows[3].computed) << "82944 numbers are more than are computed";
  for (const LowRankTableRow& row : rows) {
    EXPECT_EQ(row.times.size(), 4);
    for (const FrameTimes& frame : row.times) {
      EXPECT_TRUE(frame.full_frame && frame.full_sums);
      EXPECT_GT(frame.sparse_sums.min, 0);
      EXPECT_LE(frame.sparse_frame.min, frame.sparse_frame.median);
      EXPECT_EQ(frame.sparse_bandwidth.has_value(), row.size.rows == 3456);
    }
    EXPECT_NEAR(static_cast<double>(row.full_bytes) / static_cast<double>(row.sparse_bytes), 2, 0.2);
  }
  ASSERT_EQ(small_results().large_rows.size(), 2);
  EXPECT_FALSE(small_results().large_rows[0].times.front().full_frame) << "Table 5 has sparse V alone";
  EXPECT_TRUE(small_results().large_rows[0].computed) << "432 = 12 * 36 halves of squares";
  EXPECT_TRUE(small_results().large_rows[1].times.empty()) << "too large to be timed here";
}

TEST(LowRankTables, TablesHaveALineForEachSizeAndRatiosOfTheTimes) {
  const ReportSection section = low_rank_tables_section(small_results(), small_tables(), "command");
  const std::vector<std::pair<std::string, std::size_t>> lines = {
      {"Table 1", 4}, {"Table 2", 4}, {"Table 3", 5}, {"Table 4", 3}, {"Table 5", 2}, {"Error", 4}};
  for (const auto& [caption, count] : lines) {
    const ReportTable& table = table_of(section, caption);
    EXPECT_EQ(table.rows.size(), count) << caption;
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << caption;
  }
  const FrameTimes& frame = *small_results().rows[0].find(1, 1);
  const auto near = [](const std::string& cell, double number) {
    EXPECT_NEAR(std::stod(cell), number, 0.01 * number + 0.5 * (number > 100));
  };
  near(table_of(section, "Table 1").rows[0][2], frame.full_sums->min / frame.sparse_sums.min);
  near(table_of(section, "Table 2").rows[0][2], frame.full_frame->min / frame.sparse_frame.min);
  near(table_of(section, "Table 3").rows[0][3], 1 / frame.sparse_frame.min);
}

// What the document prints of its own tables agrees with itself: speed-ups of Table 2 are ratios of Table 3.
TEST(PublishedTables, AgreeWithEachOther) {
  ASSERT_EQ(published_table_3().size(), 9);
  for (const PublishedSpeeds& speeds : published_table_3()) {
    const PublishedRatios* ratios = published_row(published_table_2(), speeds.size);
    ASSERT_NE(ratios, nullptr);
    EXPECT_NEAR(ratios->full_to_sparse_cpu, speeds.sparse_cpu / speeds.full_cpu, 0.1);
    EXPECT_NEAR(ratios->full_to_sparse_gpu / (speeds.sparse_gpu / speeds.full_gpu), 1, 0.04);
    EXPECT_NEAR(ratios->sparse_cpu_to_sparse_gpu / (speeds.sparse_gpu / speeds.sparse_cpu), 1, 0.04);
    EXPECT_NE(published_row(published_table_1(), speeds.size), nullptr);
  }
  for (const PublishedSecondMachine& row : published_table_4())
    EXPECT_NEAR(row.cpu / *row.cpu_speedup, published_row(published_table_3(), row.size)->sparse_cpu, 1);
  double sum = 0;
  for (const PublishedSpeeds& speeds : published_table_3()) sum += speeds.sparse_cpu;
  EXPECT_NEAR(sum / 9, published_average().sparse_cpu, 1);
}

TEST(CubeMeshes, CountsAreMetExactlyAndNest) {
  for (const Index count : {6, 54, 12, 48, 432}) {
    const PatchMesh mesh = cube_mesh(count);
    EXPECT_EQ(mesh.patch_count(), count);
    EXPECT_NEAR(mesh.area.minCoeff(), 6.0 / static_cast<double>(count), 1e-12);
    EXPECT_NEAR(mesh.area.maxCoeff(), 6.0 / static_cast<double>(count), 1e-12);
  }
  EXPECT_THROW(cube_mesh(100), UsageError);
  EXPECT_THROW(cube_mesh(0), UsageError);
}

/// Rows 0 ... 99 in segments of 30, 0, 41 and 29.
Segments uneven_segments() {
  return Segments({0, 30, 30, 71, 100});
}

Eigen::MatrixXd small_factor() {
  RandomStream random(3);
  Eigen::MatrixXd U(100, 4);
  for (double& entry : U.reshaped()) entry = random.uniform(0, 0.01);
  return U;
}

TEST(PrecomputedWoodbury, SolvesTheEquationOfItsFactors) {
  const Segments V = uneven_segments();
  const Eigen::VectorXd reflectance = Eigen::VectorXd::LinSpaced(100, 0.1, 0.9);
  SilentMonitor monitor;
  const TallMatrix<float> Y = precompute_woodbury(V, TallMatrix<float>(small_factor()), reflectance, monitor);
  const TallMatrix<float> full = full_matrix(V);
  const Eigen::MatrixXd E = Eigen::VectorXd::LinSpaced(100, 1, 2);
  Eigen::MatrixXd X(4, 1);
  Eigen::MatrixXd B(100, 1);
  multiply_transposed(full, E, X);
  EXPECT_NEAR(X(2, 0), E.col(0).segment(30, 41).sum(), 1e-5);
  EXPECT_EQ(X(1, 0), 0);
  subtract_product(Y, X, E, B);
  multiply_transposed(full, B, X);
  const Eigen::MatrixXd residual = E + reflectance.asDiagonal() * small_factor() * X - B;
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT((B - E).minCoeff(), 1e-3) << "light is reflected";
}

TEST(PrecomputedWoodbury, RefusesWhatDoesNotFitAndWhatIsSingular) {
  SilentMonitor monitor;
  EXPECT_THROW(
      precompute_woodbury(uneven_segments(), TallMatrix<float>(100, 3), Eigen::VectorXd::Ones(100), monitor),
      UsageError);
  // One segment and U = 1/100: all light returns.
  TallMatrix<float> U(Eigen::MatrixXd::Constant(128, 1, 1.0 / 128));
  EXPECT_THROW(precompute_woodbury(Segments({0, 128}), std::move(U), Eigen::VectorXd::Ones(128), monitor),
               Error);
}

TEST(LowRankTables, WritesFilesAndASection) {
  const TemporaryFolder temporary;
  LowRankTablesOptions options = small_tables();
  options.sizes.resize(1);
  options.large_sizes.clear();
  SilentMonitor monitor;
  const ReportSection section = low_rank_tables(temporary.path(), "command", options, monitor);
  std::ifstream file(temporary.path() / "low_rank_tables.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json.at("sizes").size(), 1);
  EXPECT_EQ(json.at("sizes")[0].at("times").size(), 4);
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "low_rank_tables.csv"));
  Report report;
  report.sections.push_back(section);
  EXPECT_NE(to_html(report).find("Table 5"), std::string::npos);
}

}  // namespace
}  // namespace radiosity
