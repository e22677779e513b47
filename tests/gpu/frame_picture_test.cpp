#include "frame/picture_difference.hpp"
#include "frame/traced_frame.hpp"
#include "tests/gpu/frame_test.hpp"
#include "tests/temporary_folder.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <string>

namespace radiosity {
namespace {

constexpr int picture_width = 64;
constexpr int picture_height = 48;

/// Means over 8 x 8 pixels: of noise an eighth is left, and little of silhouettes that are rounded to pixels
/// otherwise.
Picture in_blocks(const Picture& picture) {
  constexpr int side = 8;
  Picture blocks{picture.width / side, picture.height / side, {}};
  blocks.pixels.resize(picture.pixels.size() / (side * side), 0.F);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        blocks.pixel(x / side, y / side)[c] += picture.pixel(x, y)[c] / (side * side);
  return blocks;
}

Picture black_of(const Picture& picture) {
  return {picture.width, picture.height, std::vector<float>(picture.pixels.size(), 0.F)};
}

using FramePicture = FrameTest;

/// Path tracing shares no transport code with the frame. What is left beside its noise: 300 patches of
/// constant light, interpolated, and the borders of shadows and silhouettes.
TEST_F(FramePicture, IsThatOfPathTracing) {
  const auto mesh = box(300);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  const FrameScene scene = frame_scene(mesh, 4);
  const Camera camera = camera_of({}, *mesh);
  SilentMonitor monitor;
  for (const FrameLightKind kind : {FrameLightKind::point, FrameLightKind::spot}) {
    const std::vector<FrameLight> lights = light_at(*mesh, 3, 4, kind);  // in front of the blocks
    const TracedFrame traced =
        trace_frame(*mesh, lights, camera, {picture_width, picture_height, 64, 1}, monitor);
    const Picture blocks = in_blocks(traced.picture);
    const TracedFrame expected{blocks, black_of(blocks)};
    const auto difference = [&](int products) {
      FrameRenderer renderer(device(), scene, *transport, {kind},
                             {picture_width, picture_height, 512, products});
      return difference_of(in_blocks(renderer.radiance(lights, camera)), expected);
    };
    const PictureDifference whole = difference(8);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LT(std::fabs(whole.mean[c]), 0.02) << c;
      EXPECT_LT(whole.rms[c], 0.08) << c;
    }
    EXPECT_LT(difference(1).mean[0], -0.03) << "would not notice missing bounces";
  }
}

TEST_F(FramePicture, OfASimplifiedSceneIsNearlyThatOfTheSceneItself) {
  const auto mesh = box(150);
  const SimplifiedScene simplified = simplify_to_voxels(*mesh, 200);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  const auto coarse = on_device("dense:f32", form_factors_of(simplified.mesh));
  const FrameOptions options{picture_width, picture_height, 256, 8};
  FrameRenderer whole(device(), frame_scene(mesh, 4), *transport, {FrameLightKind::point}, options);
  FrameRenderer few(device(), frame_scene(simplified, mesh, 4), *coarse, {FrameLightKind::point}, options);
  const std::vector<FrameLight> lights = light_at(*mesh, 1, 4);
  const Camera camera = camera_of({}, *mesh);
  const Picture expected = whole.radiance(lights, camera);
  const PictureDifference difference =
      difference_of(few.radiance(lights, camera), {expected, black_of(expected)});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(std::fabs(difference.mean[c]), 0.05) << c;
}

TEST(PictureDifferences, AreRelativeToTheReferenceAndFreeOfItsNoise) {
  const Picture reference{2, 1, {1, 2, 0, 3, 2, 0}};
  const Picture noise{2, 1, {0, 0, 0, 0, 1, 0}};
  const Picture picture{2, 1, {2, 2, 0, 2, 3, 0}};
  const PictureDifference difference = difference_of(picture, {reference, noise});
  EXPECT_EQ(difference.mean, (std::array<double, 3>{0, 0.25, 0}));
  EXPECT_EQ(difference.absolute, (std::array<double, 3>{0.5, 0.25, 0}));
  EXPECT_EQ(difference.rms, (std::array<double, 3>{0.5, 0, 0})) << "green is noise alone";
  EXPECT_EQ(difference.picture.pixels, (std::vector<float>{1, 0, 0, 1, 1, 0}));
  EXPECT_THROW(difference_of({1, 1, {0, 0, 0}}, {reference, noise}), UsageError);
}

class FramePaths : public testing::Test {
 protected:
  std::vector<FrameView> read(const std::string& text) const {
    const auto file = folder_.path() / "path.txt";
    std::ofstream(file) << text;
    return read_frame_path(file);
  }
  std::string refusal_of(const std::string& text) const {
    try {
      read(text);
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(FramePaths, HaveALineAFrame) {
  const auto views = read("# a light\n1 2 3\n\n4 5 6  7 8 9  -1 0.5 2e1 # and a camera\r\n");
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].light, Vector3(1, 2, 3));
  EXPECT_FALSE(views[0].camera.has_value());
  EXPECT_EQ(views[1].camera, Vector3(7, 8, 9));
  EXPECT_EQ(views[1].target, Vector3(-1, 0.5, 20));
}

TEST_F(FramePaths, AreRefusedWithTheLineThatIsWrong) {
  EXPECT_NE(refusal_of("1 2 3\n1 2\n").find("line 2: there are 2 numbers"), std::string::npos);
  EXPECT_NE(refusal_of("1 2 x3\n").find("line 1: 'x3' is not a number"), std::string::npos);
  EXPECT_NE(refusal_of("1 2 nan\n").find("'nan'"), std::string::npos);
  EXPECT_NE(refusal_of("1 2 3\n1 2 3 4 5 6 4 5 6\n").find("line 2: the camera"), std::string::npos);
  EXPECT_NE(refusal_of("# nothing\n").find("no line"), std::string::npos);
  EXPECT_THROW(read_frame_path(folder_.path() / "no-such"), UsageError);
}

TEST_F(FramePaths, OfAnOrbitStayInTheBoxAndCloseAfterATurn) {
  const PatchMesh mesh = make_patches(built_in_scene("cornell-box"));
  const auto views = orbit_path(mesh, 8);
  ASSERT_EQ(views.size(), 8U);
  Vector3 middle = Vector3::Zero();
  for (const FrameView& view : views) middle += view.light / 8;
  EXPECT_NEAR(middle.x(), 0.278, 1e-3);
  EXPECT_NEAR(middle.y(), 0.8 * 0.5488, 1e-3);
  EXPECT_NEAR((views[0].light - views[4].light).norm(), 0.278, 1e-3);
}

}  // namespace
}  // namespace radiosity
