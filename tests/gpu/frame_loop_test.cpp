#include "render/tone_mapping.hpp"
#include "render/vertex_radiosity.hpp"
#include "tests/gpu/frame_test.hpp"
#include "tests/gpu/gl_call_counter.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace radiosity {
namespace {

constexpr int bounces = 8;

int total(const std::map<std::string, int>& calls) {
  int sum = 0;
  for (const auto& [name, count] : calls) sum += count;
  return sum;
}

class FrameLoop : public FrameTest {
 protected:
  const std::shared_ptr<const PatchMesh> mesh_ = box(150);
  const FormFactors form_factors_ = form_factors_of(mesh_);
  const Camera camera_ = camera_of({}, *mesh_);

  FrameRenderer renderer(const LinearOperator& transport) const {
    return {device(), frame_scene(mesh_, 2), transport, {FrameLightKind::point}, {32, 24, 32, bounces}};
  }
};

/// D1 after 100 frames whose light moves: products of n terms in float32, `bounces` one after the other.
TEST_F(FrameLoop, TransportsAfterAHundredFramesAsTheCpuDoes) {
  const auto transport = on_device("dense:f32", form_factors_);
  FrameRenderer frames = renderer(*transport);
  for (int k = 0; k < 100; ++k) {
    frames.draw(light_at(*mesh_, k, 100), camera_);
    frames.collect();
  }
  const Field emission = frames.emission();
  const auto original = cpu_operators().make("dense:f32", form_factors_);
  Field reflected(emission.rows(), 3);
  Field B = emission;
  for (int k = 0; k < bounces; ++k) {
    original->apply(B, reflected);
    B = emission + reflected;
  }
  const Field found = mesh_->reflectance.cwiseProduct(frames.irradiance());
  const double allowed = static_cast<double>(mesh_->patch_count() + 8) * 0x1p-24 * bounces;
  EXPECT_LE((found - reflected).cwiseAbs().maxCoeff(), allowed * reflected.maxCoeff());
  EXPECT_GT(reflected.maxCoeff(), 0);

  FrameRenderer afresh = renderer(*transport);
  afresh.draw(light_at(*mesh_, 99, 100), camera_);
  EXPECT_EQ(afresh.irradiance(), frames.irradiance()) << "a frame depends on those before it";
}

/// No allocation, no reading back but of finished frames, and always the same calls.
TEST_F(FrameLoop, MakesTheSameFewCallsInEveryFrame) {
  const auto transport = on_device("dense:f32", form_factors_);
  FrameRenderer frames = renderer(*transport);
  frames.draw(light_at(*mesh_, 0, 8), camera_);
  frames.draw(light_at(*mesh_, 1, 8), camera_);
  frames.collect();
  std::map<std::string, int> first;
  {
    const GlCallCounter counter;
    for (int k = 2; k < 6; ++k) {
      frames.collect();
      frames.draw(light_at(*mesh_, k, 8), camera_);
      const auto calls = GlCallCounter::take();
      if (first.empty()) first = calls;
      EXPECT_EQ(calls, first) << "frame " << k;
    }
  }
  EXPECT_LE(total(first), 100 + 28 * bounces);
  EXPECT_EQ(first["glDispatchCompute"], 3 + 2 * bounces) << "the counter counts";
  for (const char* forbidden :
       {"glBufferData", "glTexStorage3D", "glRenderbufferStorage", "glGenBuffers", "glGenTextures",
        "glGenFramebuffers", "glGetBufferSubData", "glCreateProgram", "glGetIntegerv"})
    EXPECT_EQ(first.count(forbidden), 0U) << forbidden;
  EXPECT_EQ(first["glReadPixels"], 1);
  if (!device()->context()->software()) {
    EXPECT_EQ(first.count("glFinish"), 0U) << "timers of software renderers alone wait";
  }
}

TEST(GlCalls, AreAllKnownToTheCounter) {
  const std::vector<std::string> known = GlCallCounter::functions();
  const std::regex call("\\bgl[A-Z][A-Za-z0-9_]*(?=\\()");
  int found = 0;
  for (const char* folder : {"gpu", "frame"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(RADIOSITY_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      const std::string source = text.str();
      for (std::sregex_iterator at(source.begin(), source.end(), call), end; at != end; ++at, ++found)
        EXPECT_NE(std::find(known.begin(), known.end(), at->str()), known.end()) << at->str();
    }
  EXPECT_GT(found, 50);
}

TEST_F(FrameLoop, GivesFramesInTheirOrderToneMapped) {
  const auto transport = on_device("dense:f32", form_factors_);
  FrameRenderer frames = renderer(*transport);
  const auto first = light_at(*mesh_, 0, 4);
  const auto second = light_at(*mesh_, 2, 4);
  const Picture radiance = frames.radiance(first, camera_);
  const double exposure = exposure_of(radiance);
  frames.set_exposure(exposure);
  frames.draw(first, camera_);
  frames.draw(second, camera_);
  EXPECT_THROW(frames.draw(second, camera_), UsageError) << "two wait already";
  for (const auto& lights : {first, second}) {
    const FinishedFrame& frame = frames.collect();
    const std::vector<std::uint8_t> expected = tone_mapped(frames.radiance(lights, camera_), exposure);
    ASSERT_EQ(frame.bytes.size(), expected.size());
    int largest = 0;
    for (std::size_t k = 0; k < expected.size(); ++k)
      largest = std::max(largest, std::abs(int{frame.bytes[k]} - int{expected[k]}));
    EXPECT_LE(largest, 1) << "the device encodes as sRGB says";
    ASSERT_EQ(frame.stage_seconds.size(), frame_stages.size());
    EXPECT_GT(*std::min_element(frame.stage_seconds.begin(), frame.stage_seconds.end()), 0);
  }
  EXPECT_THROW(frames.collect(), UsageError);
  EXPECT_NE(frames.radiance(second, camera_).pixels, radiance.pixels);
}

TEST(FrameMeshes, GatherAsVertexRadiosityDoes) {
  const PatchMesh mesh = make_patches(built_in_scene("cornell-box"), {.patches = 150});
  const FrameMesh frame = frame_mesh(mesh);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(mesh.patch_count(), 1);
  const VertexRadiosity vertices(mesh, B);
  std::size_t triangle = 0;
  for (Index patch = 0; patch < mesh.patch_count(); ++patch)
    for (int k = 2; k < mesh.patches[static_cast<std::size_t>(patch)].corner_count; ++k, ++triangle) {
      ASSERT_EQ(frame.patch_of_triangle[triangle], patch);
      for (const auto& [corner, of_patch] : {std::pair{0, 0}, {1, k - 1}, {2, k}}) {
        const std::uint32_t vertex = frame.triangles[triangle][static_cast<std::size_t>(corner)];
        double gathered = 0;
        for (std::uint32_t at = frame.gather_begin[vertex]; at < frame.gather_begin[vertex + 1]; ++at)
          gathered += static_cast<double>(frame.gather_weight[at]) * B(frame.gather_patch[at], 0);
        EXPECT_NEAR(gathered, vertices.corner(patch, of_patch)[0], 1e-6);
        EXPECT_EQ(Vector3(frame.position.col(vertex)), mesh.corner(patch, of_patch));
      }
    }
}

}  // namespace
}  // namespace radiosity
