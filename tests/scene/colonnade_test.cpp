#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr double kLength = 12, kBreadth = 8.5, kStorey = 4, kRoof = 0.75, kNaveWidth = 3.5, kColumn = 0.5;
constexpr double kClothHeight = 2.5, kBayLength = 2;

TEST(Colonnade, IsWatertightUnderItsCanopy) {
  for (const Index patches : {0, 900}) {
    const PatchMesh mesh = make_patches(built_in_scene("colonnade:sky=closed"), {.patches = patches});
    EXPECT_TRUE(mesh.topology.enclosure);
    EXPECT_FALSE(mesh.topology.convex);
    const double air = (kLength * kBreadth - 8 * kColumn * kColumn) * kStorey + kLength * kNaveWidth * kRoof;
    EXPECT_NEAR(mesh.topology.volume, -air, 1e-9);
    EXPECT_EQ(unmatched_edges(mesh), 0);
    EXPECT_NEAR(area_by_group(mesh).at("sky"), kLength * kNaveWidth, 1e-9);
  }
}

TEST(Colonnade, IsOpenAboveTheNaveOnly) {
  const PatchMesh mesh = make_patches(built_in_scene("colonnade"));
  EXPECT_FALSE(mesh.topology.closed);
  EXPECT_FALSE(area_by_group(mesh).contains("sky"));
  EXPECT_EQ(unmatched_edges(mesh), 2 * 9 + 2)
      << "nine bays and columns along each side, one edge at each end";
  EXPECT_LT(mesh.patch_count(), 400);
}

// The check can fail: a face the other way round, or one that is missing.
TEST(Colonnade, IsNotWatertightWithAFlippedOrMissingFace) {
  const Scene whole = built_in_scene("colonnade:sky=closed");
  for (std::size_t f = 0; f < whole.faces.size(); f += 31) {
    Scene flipped = whole, missing = whole;
    std::reverse(flipped.faces[f].corners.begin(), flipped.faces[f].corners.end());
    missing.faces.erase(missing.faces.begin() + static_cast<std::ptrdiff_t>(f));
    EXPECT_FALSE(topology(flipped).closed) << f;
    EXPECT_FALSE(topology(missing).closed) << f;
  }
}

TEST(Colonnade, HasEightColumnsBetweenRedAndBlueCloth) {
  const PatchMesh mesh = make_patches(built_in_scene("colonnade"));
  const auto areas = area_by_group(mesh);
  for (int column = 1; column <= 8; ++column)
    EXPECT_NEAR(areas.at(fmt::format("column{}", column)), 4 * kColumn * kStorey, 1e-12) << column;
  for (const char* side : {"left", "right"}) {
    EXPECT_NEAR(areas.at(fmt::format("{}/cloth", side)), 5 * kBayLength * kClothHeight, 1e-12);
    EXPECT_NEAR(areas.at(fmt::format("{}/lamp", side)), kBayLength * kBayLength, 1e-12);
  }
  EXPECT_NEAR(areas.at("floor"), kLength * kBreadth - 8 * kColumn * kColumn, 1e-12);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const auto reflectance = mesh.reflectance.row(i);
    if (group_name(mesh, i) == "left/cloth") {
      EXPECT_GT(reflectance[0], 5 * reflectance[2]);
    }
    if (group_name(mesh, i) == "right/cloth") {
      EXPECT_GT(reflectance[2], 5 * reflectance[0]);
    }
    EXPECT_EQ(mesh.emission.row(i).minCoeff() > 0, group_name(mesh, i).ends_with("/lamp"));
  }
}

}  // namespace
}  // namespace radiosity
