#include "experiments/dxt_radiosity/frame_comparison.hpp"
#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "scene/built_in.hpp"
#include "tests/gpu/device_test.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace radiosity {
namespace {

constexpr int width = 96;
constexpr int height = 54;

class ColumnProfiles : public ::testing::Test {
 protected:
  ColumnBands bands(const std::string& group, const Vector3& normal, int count = 8) const {
    return column_bands(mesh_, group, normal, *mesh_.scene->camera, width, height, count);
  }

  PatchMesh mesh_ = make_patches(built_in_scene("colonnade"));
  Vector3 towards_nave_ = -Vector3::UnitZ();
};

TEST_F(ColumnProfiles, RunFromFootToHead) {
  const ColumnBands found = bands("column6", towards_nave_);
  ASSERT_EQ(found.height.size(), 8U);
  EXPECT_NEAR(found.height.front(), 0.25, 1e-12);
  EXPECT_NEAR(found.height.back(), 3.75, 1e-12);
  for (std::size_t band = 1; band < found.pixels.size();
       ++band)  // the foot is below: rows count from the top
    EXPECT_LT(found.pixels[band].front() / width, found.pixels[band - 1].front() / width + 1);
  EXPECT_LT(found.pixels.back().front() / width + 10, found.pixels.front().back() / width);
}

/// A picture whose red share falls by 5 % a metre along the column.
TEST_F(ColumnProfiles, HaveTheGradientOfThePicture) {
  const ColumnBands found = bands("column6", towards_nave_);
  Picture picture{width, height, std::vector<float>(std::size_t{3} * width * height, 1000.F)};
  for (std::size_t band = 0; band < found.pixels.size(); ++band)
    for (const std::size_t pixel : found.pixels[band]) {
      const auto red = static_cast<float>(0.5 - 0.05 * found.height[band]);
      picture.pixels[3 * pixel] = 4 * red;
      picture.pixels[3 * pixel + 1] = 4 * (1 - red);
      picture.pixels[3 * pixel + 2] = 0;
    }
  const Eigen::MatrixX3d profile = profile_of(picture, found);
  EXPECT_NEAR(colour_gradient(found, profile), -0.05, 1e-6);
  EXPECT_NEAR(profile_error(1.1 * profile, profile).head<2>().minCoeff(), 0.1, 0.02);
  EXPECT_EQ(profile_error(profile, profile).head<2>().maxCoeff(), 0);
}

TEST_F(ColumnProfiles, AreRefusedWhereNothingIsSeen) {
  EXPECT_THROW(bands("column60", towards_nave_), UsageError);
  EXPECT_THROW(bands("column6", Vector3::UnitZ()), UsageError) << "its far side";
  EXPECT_THROW(bands("column6", towards_nave_, 500), UsageError);
  EXPECT_THROW(bands("column6", towards_nave_, 1), UsageError);
}

class FrameComparisons : public DeviceTest {
 protected:
  static FrameComparisonOptions tiny() {
    FrameComparisonOptions options;
    options.patches = 400;
    options.tolerance = 1e-2;
    options.width = width;
    options.height = height;
    options.shadow_size = 256;
    options.points = 3;
    options.bands = 6;
    options.reference_paths = 32;
    options.times_more = 16;
    options.cells = 12;
    options.steps = 24;
    options.seconds = 0;
    return options;
  }

  SilentMonitor monitor_;
};

TEST_F(FrameComparisons, TellTheMethodsApart) {
  const FrameComparison comparison = measure_frame_comparison(device(), tiny(), cpu_operators(), monitor_);
  ASSERT_EQ(comparison.frames.size(), 9U);
  const auto frame = [&](const std::string& name) -> const ComparedFrame& {
    return *std::find_if(comparison.frames.begin(), comparison.frames.end(),
                         [&](const ComparedFrame& own) { return own.name == name; });
  };
  for (const ComparedFrame& own : comparison.frames) {
    EXPECT_GT(own.seconds, 0) << own.name;
    EXPECT_EQ(own.profile.rows(), 6) << own.name;
  }
  const ComparedFrame& whole = frame("radiosity, all bounces");
  EXPECT_LT(std::fabs(whole.whole.mean[1]), 0.04);
  EXPECT_LT(frame("naive radiosity").whole.mean[1], whole.whole.mean[1] - 0.03) << "has three bounces";
  EXPECT_LT(frame("path tracing").whole.mean[1], 0.04);
  EXPECT_LT(frame("instant radiosity, 16 times more").shadowed.rms[1],
            0.7 * frame("instant radiosity").shadowed.rms[1]);
  EXPECT_LT(frame("its first reflection alone").whole.mean[1],
            frame("instant radiosity, 16 times more").whole.mean[1]);
  EXPECT_LT(frame("light propagation volumes").shadowed.mean[1], 0) << "has one reflection";
  EXPECT_GT(comparison.shadowed_part, 0.3);
  EXPECT_LT(comparison.shadowed_part, 1);
}

TEST_F(FrameComparisons, WriteFiguresNumbersAndASection) {
  const TemporaryFolder temporary;
  const auto folder = temporary.path() / "results";
  FrameComparisonOptions options = tiny();
  options.reference_paths = 4;
  const ReportSection section =
      frame_comparison(folder, "command", device(), options, cpu_operators(), monitor_);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  const std::string text = to_text(section);
  EXPECT_NE(text.find(device()->context()->renderer()), std::string::npos);
  EXPECT_EQ(text.find("software renderer") != std::string::npos, device()->context()->software());
  std::ifstream file(folder / "frame_comparison.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json.at("frames").size(), 9U);
  EXPECT_EQ(json.at("frames").at(0).at("profile").size(), 6U);
  EXPECT_EQ(json.at("heights").size(), 6U);
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_comparison.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "frame_comparison_difference.png"));
}

TEST(SkippedFrameComparison, SaysWhy) {
  const std::string text = to_text(skipped_frame_comparison("there is no OpenGL here: install libegl1"));
  EXPECT_NE(text.find("install libegl1"), std::string::npos);
}

}  // namespace
}  // namespace radiosity
