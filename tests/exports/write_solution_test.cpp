#include "foundation/error.hpp"
#include "foundation/npy.hpp"
#include "render/tone_mapping.hpp"
#include "render/write_solution.hpp"
#include "tests/render/rooms.hpp"
#include "tests/temporary_folder.hpp"

#include <OpenImageIO/imageio.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>

namespace radiosity {
namespace {

namespace fs = std::filesystem;
using namespace test;

/// A room with a different B on every patch, and a folder of its own that is removed in the end.
class WriteSolution : public ::testing::Test {
 protected:
  void SetUp() override {
    Scene scene = box_room({1, 2, 3});
    for (Vector3& vertex : scene.vertices) vertex += Vector3(1e5, 0, 0);  // float32 positions would lose this
    mesh_ = make_patches(scene, {.patches = 54});
    B_.resize(mesh_.patch_count(), 3);
    for (Index i = 0; i < B_.rows(); ++i)
      B_.row(i) << 1 + 0.01 * static_cast<double>(i), 2 - 0.01 * static_cast<double>(i), 1 / 3.0;
  }

  std::string write(const std::string& name) {
    SilentMonitor monitor;
    return write_solution(folder_ / name, mesh_, B_, {.width = 60, .height = 40}, monitor);
  }

  std::string contents(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  unsigned patches() const { return static_cast<unsigned>(mesh_.patch_count()); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  PatchMesh mesh_;
  Eigen::MatrixXd B_;
};

TEST_F(WriteSolution, NpyHoldsTheSameBits) {
  write("b.npy");
  EXPECT_EQ(read_npy(folder_ / "b.npy"), B_);
  EXPECT_EQ(files(), 1U);
}

TEST_F(WriteSolution, ExrHoldsRadiance) {
  write("b.EXR");
  const auto image = OIIO::ImageInput::open((folder_ / "b.EXR").string());
  ASSERT_TRUE(image);
  EXPECT_EQ(image->spec().width, 60);
  EXPECT_EQ(image->spec().height, 40);
  EXPECT_EQ(image->spec().nchannels, 3);
  EXPECT_EQ(image->spec().format, OIIO::TypeDesc::FLOAT);
  std::vector<float> pixels(3 * 60 * 40);
  ASSERT_TRUE(image->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, pixels.data()));
  SilentMonitor monitor;
  EXPECT_EQ(pixels, render_picture(mesh_, B_, {.width = 60, .height = 40}, monitor).pixels);
  const float* middle = &pixels[3 * (20 * 60 + 30)];
  EXPECT_NEAR(middle[2], 1 / 3.0 / std::numbers::pi, 1e-6);
}

TEST_F(WriteSolution, PngHoldsTonedPixels) {
  const std::string note = write("b.png");
  const auto image = OIIO::ImageInput::open((folder_ / "b.png").string());
  ASSERT_TRUE(image);
  EXPECT_EQ(image->spec().width, 60);
  EXPECT_EQ(image->spec().height, 40);
  EXPECT_EQ(image->spec().format, OIIO::TypeDesc::UINT8);
  std::vector<std::uint8_t> pixels(3 * 60 * 40);
  ASSERT_TRUE(image->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, pixels.data()));
  SilentMonitor monitor;
  const Picture picture = render_picture(mesh_, B_, {.width = 60, .height = 40}, monitor);
  const double exposure = exposure_of(picture);
  EXPECT_EQ(pixels, tone_mapped(picture, exposure));
  EXPECT_NE(note.find(fmt::format("{:.4g}", exposure)), std::string::npos) << note;
}

TEST_F(WriteSolution, GlbIsReadByOthers) {
  write("b.glb");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_ / "b.glb").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1U);
  const aiMesh& read = *scene->mMeshes[0];
  EXPECT_EQ(read.mNumVertices, 4U * patches());
  EXPECT_EQ(read.mNumFaces, 2U * patches());
  ASSERT_TRUE(read.HasVertexColors(0));
  const double exposure = exposure_of(B_, mesh_.area);
  for (Index i = 0; i < mesh_.patch_count(); ++i)
    for (int k = 0; k < 4; ++k) {
      const auto at = static_cast<unsigned>(4 * i + k);
      const aiColor4D& color = read.mColors[0][at];
      EXPECT_NEAR(color.r, std::min(1.0, exposure * B_(i, 0) / std::numbers::pi), 1e-6);
      EXPECT_NEAR(color.b, std::min(1.0, exposure * B_(i, 2) / std::numbers::pi), 1e-6);
      const Vector3 expected = mesh_.corner(i, k) - Vector3(1e5 + 0.5, 1, 1.5);
      EXPECT_NEAR(read.mVertices[at].x, expected.x(), 1e-6);
      EXPECT_NEAR(read.mVertices[at].y, expected.y(), 1e-6);
      EXPECT_NEAR(read.mVertices[at].z, expected.z(), 1e-6);
    }
}

TEST_F(WriteSolution, GlbKeepsToTheSpecification) {
  write("b.glb");
  const std::string bytes = contents("b.glb");
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2U);
  EXPECT_EQ(word(8), bytes.size());
  const std::uint32_t json_length = word(12);
  EXPECT_EQ(json_length % 4, 0U);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  const std::size_t binary = 20 + json_length;
  EXPECT_EQ(word(binary) % 4, 0U);
  EXPECT_EQ(bytes.substr(binary + 4, 4), std::string("BIN\0", 4));

  const auto document = nlohmann::json::parse(bytes.substr(20, json_length));
  EXPECT_EQ(document["asset"]["version"], "2.0");
  EXPECT_EQ(document["buffers"][0]["byteLength"], word(binary));
  EXPECT_EQ(document["extensionsUsed"][0], "KHR_materials_unlit");
  EXPECT_TRUE(document["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  const auto& primitive = document["meshes"][0]["primitives"][0];
  const auto& colors = document["accessors"][primitive["attributes"]["COLOR_0"].get<std::size_t>()];
  EXPECT_LE(colors["max"][0].get<double>(), 1);
  EXPECT_GE(colors["min"][0].get<double>(), 0);
  const auto& positions = document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_NEAR(positions["min"][2].get<double>(), -1.5, 1e-6);
  EXPECT_NEAR(positions["max"][2].get<double>(), 1.5, 1e-6);
  EXPECT_NEAR(document["nodes"][0]["translation"][0].get<double>(), 1e5 + 0.5, 1e-9);

  // B itself, in W/m^2, in the attribute that only this program knows.
  const auto& radiosity = document["accessors"][primitive["attributes"]["_RADIOSITY"].get<std::size_t>()];
  const auto offset =
      document["bufferViews"][radiosity["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>();
  float first[3];
  std::memcpy(first, bytes.data() + binary + 8 + offset, sizeof first);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(first[c], static_cast<float>(B_(0, c)));
}

TEST_F(WriteSolution, PlyIsReadByOthersAndKeepsB) {
  write("b.ply");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_ / "b.ply").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  const aiMesh& read = *scene->mMeshes[0];
  EXPECT_EQ(read.mNumVertices, 4U * patches());
  EXPECT_EQ(read.mNumFaces, patches());
  ASSERT_TRUE(read.HasVertexColors(0));
  const double exposure = exposure_of(B_, mesh_.area);
  EXPECT_NEAR(read.mColors[0][4 * 5].g, srgb_byte(exposure * B_(5, 1) / std::numbers::pi) / 255.0, 1e-6);

  // The faces close the file: a count, four indices and B, each of 1 + 16 + 24 bytes.
  const std::string bytes = contents("b.ply");
  for (Index i = 0; i < mesh_.patch_count(); ++i) {
    const std::size_t face = bytes.size() - static_cast<std::size_t>(mesh_.patch_count() - i) * 41;
    ASSERT_EQ(bytes[face], 4);
    double value[3];
    std::memcpy(value, bytes.data() + face + 17, sizeof value);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(value[c], B_(i, c));
  }
}

TEST_F(WriteSolution, GreySolutionsAreGreyEverywhere) {
  B_ = Eigen::MatrixXd(B_.col(0));
  for (const std::string name : {"b.npy", "b.exr", "b.png", "b.glb", "b.ply"})
    EXPECT_NO_THROW(write(name)) << name;
  EXPECT_EQ(read_npy(folder_ / "b.npy").cols(), 1);
  EXPECT_EQ(files(), 5U);
}

TEST_F(WriteSolution, UnknownExtensionsListTheKnownOnes) {
  for (const std::string name : {"b.jpg", "b", "b.npy.gz"}) {
    try {
      write(name);
      FAIL() << name << " was written";
    } catch (const UsageError& error) {
      for (const SolutionFormat& format : solution_formats())
        EXPECT_NE(std::string(error.what()).find(format.extension), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(WriteSolution, FailureLeavesNoFile) {
  B_ = Eigen::MatrixXd(B_.leftCols(2));
  for (const std::string name : {"b.exr", "b.png", "b.glb", "b.ply"})
    EXPECT_THROW(write(name), UsageError) << name;
  B_ = Eigen::MatrixXd::Zero(3, 3);
  EXPECT_THROW(write("b.npy"), UsageError);
  EXPECT_EQ(files(), 0U);

  SetUp();
  for (const std::string name : {"b.npy", "b.exr", "b.png", "b.glb", "b.ply"}) {
    EXPECT_THROW(write("missing/" + name), Error) << name;
    EXPECT_FALSE(fs::exists(folder_ / "missing"));
  }

  // Interrupted while drawing.
  class Impatient final : public Monitor {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } monitor;
  EXPECT_THROW(write_solution(folder_ / "b.png", mesh_, B_, {}, monitor), Cancelled);
  EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace radiosity
