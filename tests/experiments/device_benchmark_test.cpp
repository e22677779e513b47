#include "experiments/device/device_benchmark.hpp"
#include "experiments/dxt_radiosity/dxt_speed.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "foundation/error.hpp"
#include "tests/gpu/device_test.hpp"
#include "tests/temporary_folder.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace radiosity {
namespace {

/// Whether a section says so in a text or in the heading of a table.
bool section_names(const ReportSection& section, const std::string& what) {
  return to_html({"report", "", "", {section}}).find(what) != std::string::npos;
}

/// Numbers of a graphics card that does not exist.
DeviceResults made_up_results() {
  DeviceResults results;
  results.renderer = "Card 9000";
  results.vendor = "Vendor";
  results.version = "4.6";
  DeviceFrames frames;
  frames.size = {216, 54};
  frames.sparse = {{1e-5, 2e-5}, {2e-5, 3e-5}, {1e-4, 2e-4}};
  frames.full = DeviceFrameTimes{{3e-5, 4e-5}, {5e-5, 6e-5}, {2e-4, 3e-4}};
  frames.hybrid_sparse = frames.cpu_sparse = {1e-3, 2e-3};
  frames.hybrid_full = frames.cpu_full = Timing{2e-3, 3e-3};
  results.frames = {frames};
  frames.size = {3456, 24};
  frames.full = std::nullopt;
  frames.hybrid_full = frames.cpu_full = std::nullopt;
  results.frames.push_back(frames);
  const DeviceMethodSpeed naive{"naive", 1000, {1e-3, 1e-3}, {2e-3, 2e-3}, 1e-7};
  results.over_patches = {{60, 3, 3, {naive, {"sum, DXT", 400, {1e-4, 1e-4}, {1e-3, 1e-3}, 1e-7}}}};
  results.over_bounces = results.over_patches;
  results.costs = {{"dense:f32", 3, 1e-3, 5e-3, 10}};
  return results;
}

TEST(DeviceResults, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  const DeviceResults results = made_up_results();
  write_device_results(folder.path() / "device.json", results);
  const DeviceResults read = read_device_results(folder.path() / "device.json");
  EXPECT_EQ(device_results_json(read), device_results_json(results));
  EXPECT_EQ(read.find({216, 54}, 1)->full->frame.min, 5e-5);
  EXPECT_EQ(read.find({216, 55}, 1), nullptr);
  EXPECT_FALSE(read.frames[1].full.has_value());
}

TEST(DeviceResults, ThatAreSomethingElseAreRefusedInASentence) {
  const TemporaryFolder folder;
  for (const char* text :
       {"{\"kind\": \"another\"}", "{\"kind\": \"radiosity device benchmark\"}", "no JSON"}) {
    std::ofstream(folder.path() / "other.json") << text;
    try {
      read_device_results(folder.path() / "other.json");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("bench --device gl"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_device_results(folder.path() / "missing.json"), Error);
}

/// A column with the renderer's name, in place of one that is empty.
TEST(DeviceResults, FillTheColumnsOfDocument004sTables) {
  LowRankTables tables;
  tables.rows.resize(1);
  tables.rows[0].size = {216, 54};
  LowRankTablesOptions options;
  EXPECT_TRUE(section_names(low_rank_tables_section(tables, options, ""), "GPU full"));
  options.device = std::make_shared<const DeviceResults>(made_up_results());
  const ReportSection section = low_rank_tables_section(tables, options, "");
  EXPECT_TRUE(section_names(section, "Card 9000 full"));
  EXPECT_FALSE(section_names(section, "software renderer"));
  for (const ReportBlock& block : section.blocks)
    if (const auto* table = std::get_if<ReportTable>(&block);
        table && table->caption.starts_with("Table 3")) {
      EXPECT_EQ(table->rows[0][8], "20000") << "1 / 5e-5 frames a second with full V";
      EXPECT_EQ(table->rows[0][9], "50000");
    }
}

TEST(DeviceResults, SayThatTheyAreASoftwareRenderers) {
  DeviceResults results = made_up_results();
  EXPECT_EQ(device_text(results).text.find("software"), std::string::npos);
  results.software = true;
  EXPECT_NE(device_text(results).text.find("software renderer"), std::string::npos);
}

using DeviceBenchmark = DeviceTest;

TEST_F(DeviceBenchmark, MeasuresWhatTheTablesNeedAndRightProducts) {
  DeviceBenchmarkOptions options;
  options.sizes = {{216, 54}};
  options.large_sizes = {{3538944, 216}};
  options.patches = {240};  // fewer take less memory than tables of palettes do
  options.patches_over_bounces = 60;
  options.bounce_counts = {1};
  options.costs = {.patches = 70, .factors = {216, 54}, .seconds = 0.001};
  options.seconds = 0.001;
  SilentMonitor monitor;
  const DeviceResults results = benchmark_device(device(), options, cpu_operators(), monitor);
  EXPECT_EQ(results.renderer, device()->context()->renderer());
  EXPECT_EQ(results.software, device()->context()->software());
  ASSERT_EQ(results.frames.size(), 2U) << "one and three columns; the largest is left out";
  EXPECT_TRUE(results.find({216, 54}, 3)->full.has_value());
  for (const DeviceFrames& frames : results.frames) {
    EXPECT_GT(frames.sparse.sums.min, 0);
    EXPECT_GT(frames.sparse.with_transfers.min, 0);
    EXPECT_LE(frames.hybrid_sparse.min, frames.hybrid_sparse.median);
  }
  ASSERT_EQ(results.over_bounces.size(), 1U);
  for (const DeviceSpeedRound& round : {results.over_patches[0], results.over_bounces[0]}) {
    EXPECT_EQ(round.methods.size(), 5U);
    for (const DeviceMethodSpeed& method : round.methods) {
      EXPECT_LT(method.difference, 1e-5) << method.name << ", " << round.bounces << " bounces";
      EXPECT_GT(method.on_device.min, 0) << method.name;
    }
  }
  EXPECT_GT(results.over_patches[0].find("naive")->bytes, results.over_patches[0].find(document_sum)->bytes);
  EXPECT_EQ(results.costs.size(), 8U);
  for (const ProductCost& cost : results.costs) EXPECT_GT(cost.ratio(), 0) << cost.product;
  EXPECT_TRUE(section_names(device_section(results, ""), results.renderer.substr(0, 8)));
}

}  // namespace
}  // namespace radiosity
