#include "experiments/low_rank_radiosity/coherence_pictures.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "experiments/low_rank_radiosity/patch_view.hpp"
#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

/// Width and height of a PNG file from its header.
std::pair<int, int> png_size(const std::vector<std::uint8_t>& bytes) {
  const auto number = [&](std::size_t at) {
    return (bytes.at(at) << 24) | (bytes.at(at + 1) << 16) | (bytes.at(at + 2) << 8) | bytes.at(at + 3);
  };
  return {number(16), number(20)};
}

CoherencePictureOptions small_pictures() {
  CoherencePictureOptions options;
  options.view_patches = 100;
  options.fine_patches = 300;
  options.coarse_patches = 60;
  options.directions = 64;
  options.picture_size = 48;
  return options;
}

TEST(CoherencePictures, FiguresHaveTheirSizes) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "results";
  SilentMonitor monitor;
  const ReportSection section =
      low_rank_pictures(folder, "radiosity reproduce low-rank-pictures", small_pictures(), monitor);
  std::vector<std::pair<int, int>> sizes;
  int drawn = 0;
  for (const ReportBlock& block : section.blocks)
    if (const auto* figure = std::get_if<ReportFigure>(&block)) {
      if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&figure->image))
        sizes.push_back(png_size(*bytes));
      else
        ++drawn;
    }
  const std::pair<int, int> two{2 * 48 + 12, 48}, one{48, 48}, three{3 * 48 + 2 * 12, 48};
  EXPECT_EQ(sizes, (std::vector<std::pair<int, int>>{two, two, one, three}));
  EXPECT_EQ(drawn, 3);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  EXPECT_TRUE(fs::exists(folder / "low_rank_pictures.json"));
}

TEST(CoherencePictures, RefusesMoreFacesThanCoarsePatches) {
  CoherencePictureOptions options = small_pictures();
  options.coarse_patches = 5;
  SilentMonitor monitor;
  EXPECT_THROW(measure_coherence(options, monitor), UsageError);
}

// The cube has one view a face: no view differs from its neighbour's by more than the corners do, and rows of
// neighbours in the middle of a face are nearly equal.
TEST(NeighbourRows, CloseViewsHaveCloseRows) {
  SilentMonitor monitor;
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 600}));
  const FormFactors form_factors = compute_form_factors(mesh, {}, monitor);
  const auto pairs = neighbouring_pairs(form_factors, SceneViews(*mesh, 64, 1));
  ASSERT_GE(pairs.size(), 300U);
  for (const NeighbourPair& pair : pairs) {
    const Eigen::VectorXd a = form_factors.matrix().row(pair.first);
    EXPECT_NEAR((mesh->centroid.col(pair.first) - mesh->centroid.col(pair.second)).norm(), 0.1, 1e-12);
    EXPECT_EQ(mesh->patches[static_cast<std::size_t>(pair.first)].face,
              mesh->patches[static_cast<std::size_t>(pair.second)].face);
    if (&pair == &pairs.back()) {
      const Eigen::VectorXd b = form_factors.matrix().row(pair.second);
      EXPECT_NEAR(pair.row_difference, (a - b).norm() / std::max(a.norm(), b.norm()), 1e-12);
      EXPECT_NEAR(pair.redirected, 0.5 * (a - b).lpNorm<1>(), 1e-12);
    }
    break;
  }
}

TEST(NeighbourRows, RankCorrelation) {
  EXPECT_NEAR(rank_correlation({1, 2, 3, 10}, {0, 5, 6, 7}), 1, 1e-15);
  EXPECT_NEAR(rank_correlation({1, 2, 3}, {9, 4, 1}), -1, 1e-15);
  EXPECT_NEAR(rank_correlation({1, 2, 2, 3}, {1, 2, 3, 4}), 4.5 / std::sqrt(4.5 * 5), 1e-15);
  EXPECT_EQ(rank_correlation({1, 1, 1}, {1, 2, 3}), 0);
  EXPECT_EQ(rank_correlation({}, {}), 0);
}

}  // namespace
}  // namespace radiosity
