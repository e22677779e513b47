#include "foundation/npy.hpp"
#include "process.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace radiosity::test {
namespace {

/// Runs of the program on an OpenGL device; skipped where there is none, which ./check counts as a failure
/// with CI=true.
class Device : public testing::Test {
 protected:
  void SetUp() override {
    const ProcessResult info = run({"info", "--device", "gl"});
    if (info.exit_code == 0) return;
    EXPECT_EQ(info.exit_code, 1);
    EXPECT_NE(info.errors.find("libgl1-mesa-dri"), std::string::npos) << info.errors;
    GTEST_SKIP() << info.errors;
  }

  ProcessResult run(const std::vector<std::string>& arguments) const {
    return run_program(arguments, folder_.path());
  }
  nlohmann::json json(const std::string& file) const {
    std::ifstream stream(folder_.path() / file);
    return nlohmann::json::parse(stream);
  }

  TemporaryFolder folder_;
};

TEST_F(Device, IsDescribedByInfo) {
  const ProcessResult result = run({"info", "cube", "--device", "gl", "--json", "info.json"});
  EXPECT_EQ(result.errors, "");
  const auto device = json("info.json")["device"];
  for (const char* key : {"renderer", "version"})
    EXPECT_NE(result.output.find(device[key].get<std::string>()), std::string::npos) << key;
  EXPECT_GT(device["storage_block_bytes"], 0);
  const ProcessResult by_itself = run({"info", "--device"});
  EXPECT_EQ(by_itself.exit_code, 0) << by_itself.errors;
  EXPECT_NE(by_itself.output.find(device["renderer"].get<std::string>()), std::string::npos);
  EXPECT_EQ(run({"info", "cube", "--json", "cpu.json"}).exit_code, 0);
  EXPECT_TRUE(json("cpu.json")["device"].is_null());
}

TEST_F(Device, MultipliesInDoublePrecisionWithFactorsAndGlobalOperators) {
  const ProcessResult result =
      run({"compare", "cube", "--patches", "54", "--device", "gl", "--operators", "svd:k=4,storage=f64",
           "svd:k=4,storage=f64,global=1", "--lights", "area:1", "--json", "c.json", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  for (const auto& entry : json("c.json")["results"]) {
    EXPECT_EQ(entry["device"], "gl");
    EXPECT_LT(entry["device_difference_max"], 1e-13);
  }
}

TEST_F(Device, RefusesTwoPlacesForFactorsInDoublePrecision) {
  const ProcessResult result = run({"solve", "cube", "--patches", "54", "--device", "gl", "--operator",
                                    "svd:k=4,storage=f64,placement=hybrid"});
  EXPECT_EQ(result.exit_code, 2);
  for (const char* part : {"svd:k=4", "storage=f64", "placement=hybrid", "in float32"})
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
}

TEST_F(Device, IsNamedByEveryResultOfAComparison) {
  const ProcessResult result =
      run({"compare", "cornell-box-closed", "--patches", "150", "--device", "gl", "--operators", "dense:f32",
           "csr:f32,closure=blocks", "bounces:k=2", "--lights", "area:1", "--json", "c.json", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto results = json("c.json")["results"];
  ASSERT_EQ(results.size(), 3u);
  for (const auto& entry : results) {
    EXPECT_EQ(entry["device"], "gl");
    EXPECT_NE(result.output.find(entry["renderer"].get<std::string>()), std::string::npos);
    EXPECT_GT(entry["device_difference_max"], 0);
    EXPECT_LT(entry["device_difference_max"], 1e-5);
    EXPECT_EQ(entry["renderer"].get<std::string>().find("llvmpipe") != std::string::npos,
              result.output.find("software renderer") != std::string::npos);
  }
  EXPECT_LT(results[0]["error"]["operator_frobenius"], 1e-6);
}

TEST_F(Device, IsMeasuredByOneCommandForTheTablesOfTheDocuments) {
  const ProcessResult bench = run({"bench", "--device", "gl", "--sizes", "216x54", "--patches", "30",
                                   "--seconds", "0.001", "--json", "device.json", "--quiet"});
  ASSERT_EQ(bench.exit_code, 0) << bench.errors;
  const std::string renderer = json("device.json")["renderer"];
  EXPECT_NE(bench.output.find(renderer), std::string::npos);
  EXPECT_EQ(json("device.json")["frames"].size(), 2U);
  EXPECT_EQ(json("device.json")["over_bounces"].size(), 5U);
  const ProcessResult refused = run({"reproduce", "low-rank-tables", "--device-results", "missing.json"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.errors.find("bench --device gl"), std::string::npos) << refused.errors;
}

TEST_F(Device, SolvesAsTheCpuDoes) {
  const std::vector<std::string> command = {
      "solve", "cornell-box-closed", "--patches", "150", "--quiet", "-o", "B.npy", "--json", "B.json"};
  ASSERT_EQ(run(command).exit_code, 0);
  EXPECT_TRUE(json("B.json")["device_seconds"].is_null());
  const Eigen::MatrixXd on_cpu = read_npy(folder_.path() / "B.npy");
  std::vector<std::string> on_device = command;
  on_device.insert(on_device.end(), {"--device", "gl"});
  ASSERT_EQ(run(on_device).exit_code, 0);
  EXPECT_EQ(json("B.json")["device"], "gl");
  EXPECT_EQ(json("B.json")["operator"], "dense:f32");
  EXPECT_EQ(json("B.json")["solver"], "cg:fields=device");
  EXPECT_GT(json("B.json")["upload_seconds"], 0);
  EXPECT_GT(json("B.json")["device_seconds"], 0);
  EXPECT_LE((read_npy(folder_.path() / "B.npy") - on_cpu).norm(), 5e-6 * on_cpu.norm());
}

TEST_F(Device, RendersFramesWithTheTimesOfTheirStages) {
  const ProcessResult result = run({"render", "cornell-box", "--patches", "60", "--form-factors", "one-ray",
                                    "--frames", "3", "--size", "48x36", "--reference", "4", "--shadow-size",
                                    "256", "-o", "frames/f%02d.png", "--json", "r.json", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  for (const char* name : {"f00.png", "f01.png", "f02.png", "reference.png", "difference.png"})
    EXPECT_GT(std::filesystem::file_size(folder_.path() / "frames" / name), 100U) << name;
  const auto written = json("r.json");
  EXPECT_EQ(written["frames"], 3);
  EXPECT_EQ(written["width"], 48);
  EXPECT_GE(written["patches"], 50);
  EXPECT_EQ(written["operator"], "dense:f32");
  EXPECT_NE(result.output.find(written["renderer"].get<std::string>()), std::string::npos);
  ASSERT_EQ(written["stages"].size(), 7U);
  EXPECT_EQ(written["stages"][0]["name"], "upload");
  for (const auto& stage : written["stages"]) {
    EXPECT_GT(stage["seconds"]["min"], 0) << stage["name"];
    EXPECT_GE(stage["seconds"]["median"], stage["seconds"]["min"]) << stage["name"];
  }
  EXPECT_GT(written["frames_per_second"], 0);
  for (const auto& channel : written["reference"]["mean_difference"]) {
    EXPECT_LT(channel, 0.2);
    EXPECT_GT(channel, -0.2);
  }
}

TEST_F(Device, RendersAlongAPathOfAFileWithASumOfBounces) {
  folder_.write("path.txt", "0.3 0.4 0.3\n0.2 0.4 0.3  0.3 0.3 -0.7  0.3 0.3 0.3\n");
  const ProcessResult result =
      run({"render", "cornell-box", "--patches", "60", "--path", "path.txt", "--light", "spot", "--operator",
           "bounces:k=3", "--size", "32x24", "--shadow-size", "64", "-o", "f%d.png", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("1 product a frame"), std::string::npos) << result.output;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "f1.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "f2.png"));
}

}  // namespace
}  // namespace radiosity::test
