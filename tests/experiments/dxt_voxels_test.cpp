#include "experiments/dxt_radiosity/dxt_voxels.hpp"
#include "foundation/error.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace radiosity {
namespace {

DxtVoxelsOptions tiny_study() {
  return {.scenes = {{"cornell-box-closed", 150}, {"sphere-cavity:rings=6", 100}},
          .wanted = {40, 200},
          .lights = {.area = 1, .point = 1},
          .tolerance = 1e-2};
}

TEST(DxtVoxels, ErrorFallsWithTheirNumber) {
  SilentMonitor monitor;
  const DxtVoxels voxels = measure_dxt_voxels(tiny_study(), monitor);
  const VoxelErrors& box = voxels.scene("cornell-box-closed");
  EXPECT_EQ(box.lights, 3);
  ASSERT_EQ(box.over_voxels.size(), 2U);
  const SimplificationError &coarse = box.over_voxels.front(), &fine = box.over_voxels.back();
  EXPECT_LT(coarse.patches, fine.patches);
  EXPECT_LT(fine.indirect.mean, 0.7 * coarse.indirect.mean);
  EXPECT_LT(fine.averaged.mean, 0.7 * coarse.averaged.mean);
  EXPECT_LE(fine.indirect.mean, fine.indirect.max);
  EXPECT_EQ(fine.factor_bytes(), 4U * static_cast<std::size_t>(fine.patches * fine.patches));
  for (const VoxelErrors& scene : voxels.scenes)
    for (const SimplificationError& error : scene.over_voxels) {
      EXPECT_GT(error.indirect.mean, error.averaged.mean) << scene.scene;
      EXPECT_GT(error.form_factor_seconds, 0);
      EXPECT_GT(error.transfer_seconds, 0);
    }
  EXPECT_THROW(voxels.scene("another"), Error);

  const ReportSection section = dxt_voxels_section(voxels, tiny_study(), "command");
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
}

TEST(DxtVoxels, BlameTheShapeWhereTheErrorStaysAboveThatOfAveraging) {
  DxtVoxels voxels;
  voxels.scenes.push_back({.scene = "sloped", .patches = 100, .enclosure = true, .over_voxels = {}});
  SimplificationError error;
  error.patches = 50;
  error.indirect = {.mean = 0.3, .max = 0.4};
  error.averaged = {.mean = 0.01, .max = 0.02};
  error.leaked = 0.25;
  error.on_backs = 0.125;
  voxels.scenes.front().over_voxels = {error};
  EXPECT_NE(voxel_fault_finding(voxels).find(
                "sloped (30.0 times; 12.5 % of the rays of 50 voxels end on backs and 25.0 % leak out)"),
            std::string::npos)
      << voxel_fault_finding(voxels);
  voxels.scenes.front().over_voxels.front().indirect.mean = 0.02;
  EXPECT_EQ(voxel_fault_finding(voxels).find("sloped"), std::string::npos);
}

TEST(DxtVoxels, AreWrittenAsOneDocument) {
  const TemporaryFolder temporary;
  SilentMonitor monitor;
  DxtVoxelsOptions options = tiny_study();
  options.scenes = {{"cube", 54}};
  options.wanted = {6, 54};
  dxt_voxels(temporary.path(), "command", options, monitor);
  std::ifstream file(temporary.path() / "dxt_voxels.json");
  const auto rows = nlohmann::json::parse(file).at("scenes").at(0).at("over_voxels");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_LT(rows.at(1).at("indirect_mean").get<double>(), rows.at(0).at("indirect_mean").get<double>());
  EXPECT_EQ(rows.at(0).at("factor_bytes").get<int>(), 144);
}

TEST(DxtVoxels, NeedScenesAndNumbers) {
  SilentMonitor monitor;
  DxtVoxelsOptions options = tiny_study();
  options.wanted.clear();
  EXPECT_THROW(measure_dxt_voxels(options, monitor), UsageError);
  options = tiny_study();
  options.scenes.clear();
  EXPECT_THROW(measure_dxt_voxels(options, monitor), UsageError);
}

}  // namespace
}  // namespace radiosity
