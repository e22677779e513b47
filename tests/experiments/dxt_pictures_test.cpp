#include "experiments/dxt_radiosity/colour_matrices.hpp"
#include "experiments/dxt_radiosity/dxt_pictures.hpp"
#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

namespace radiosity {
namespace {

TEST(DxtPictures, ReorderingMovesCodesAndCompressionKeepsThemNear) {
  SilentMonitor monitor;
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 100}));
  const std::vector<ColourMatrix> matrices = colour_form_factors(compute_form_factors(mesh, {}, monitor));
  const MatrixPictures pictures = matrix_pictures(matrices, *mesh);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(pictures.before[c].cast<int>().sum(), pictures.reordered[c].cast<int>().sum());
    EXPECT_NE(pictures.before[c], pictures.reordered[c]);
    EXPECT_EQ(pictures.before[c].maxCoeff(), 255);
    const double apart = pictures.difference()[c].cast<double>().mean();
    EXPECT_GT(apart, 0);
    EXPECT_LT(apart, 16);
    const double misplaced =
        (pictures.compressed[c].cast<double>() - pictures.before[c].cast<double>()).cwiseAbs().mean();
    EXPECT_GT(misplaced, 2 * apart) << "what is compressed is the matrix in its new order";
  }
  EXPECT_THROW(matrix_pictures({matrices[0]}, *mesh), UsageError);
}

TEST(DxtPictures, FilesAreThereAndTheTextureCanBeReadBack) {
  const TemporaryFolder temporary;
  DxtPicturesOptions options;
  options.patches = 60;
  options.picture_size = 24;
  SilentMonitor monitor;
  const ReportSection section = dxt_pictures(temporary.path(), "command", options, cpu_operators(), monitor);
  EXPECT_EQ(section.blocks.size(), 4U);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  const BlockTexture<Bc1Block> texture = read_dds<Bc1Block>(temporary.path() / "dxt_texture.dds");
  EXPECT_EQ(texture.width, texture.height);
  EXPECT_GE(texture.width, 50);
  EXPECT_EQ(texture.blocks.size(), texture.block_rows() * texture.block_columns());
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "dxt_pictures.json"));
}

}  // namespace
}  // namespace radiosity
