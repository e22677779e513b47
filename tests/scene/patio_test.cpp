#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace radiosity {
namespace {

constexpr Index kSquares = 24128;  // n of document 004, figure 4
constexpr double kSide = 0.25;
constexpr double kWidth = 15.5, kCourt = 9, kHeight = 8.75, kSlabThickness = 0.75;
constexpr double kGroundCeiling = 3.75, kUpperFloor = 4.5, kParapetTop = 5.75, kUpperCeiling = 8;
constexpr double kBay = 2.5, kLampArea = kSlabThickness * 2.5;

const PatchMesh& patio_of_squares() {
  static const PatchMesh mesh = make_patches(built_in_scene("patio"), {.patches = kSquares});
  return mesh;
}

double edge_length(const PatchMesh& mesh, Index patch, int k) {
  return (mesh.corner(patch, (k + 1) % 4) - mesh.corner(patch, k)).norm();
}

TEST(Patio, HasExactlyTheSquaresOfTheDocument) {
  const PatchMesh& mesh = patio_of_squares();
  ASSERT_EQ(mesh.patch_count(), kSquares);
  for (Index i = 0; i < kSquares; ++i) {
    ASSERT_EQ(mesh.patches[static_cast<std::size_t>(i)].corner_count, 4);
    for (int k = 0; k < 4; ++k) ASSERT_NEAR(edge_length(mesh, i, k), kSide, 1e-12);
    ASSERT_NEAR(mesh.area[i], kSide * kSide, 1e-12);
  }
}

// Whatever the number, no cell is thinner than what stays whole: the pillars, lintels and bays of the scene.
TEST(Patio, ComesCloseToOtherNumbersWithoutSlivers) {
  for (const Index wanted : {600, 1508, 6032, 13000, 25000}) {
    const PatchMesh mesh = make_patches(built_in_scene("patio"), {.patches = wanted});
    EXPECT_NEAR(static_cast<double>(mesh.patch_count()) / static_cast<double>(wanted), 1, 0.01) << wanted;
    EXPECT_NEAR(mesh.area.sum(), 1508, 1e-9) << wanted;
    for (Index i = 0; i < mesh.patch_count(); ++i) {
      const double aspect = edge_length(mesh, i, 0) / edge_length(mesh, i, 1);
      ASSERT_LE(std::max(aspect, 1 / aspect), 5) << wanted << " patch " << i;
    }
  }
}

// Layer by layer: of the storeys without their pillars, the galleries behind the parapets, and the court.
double volume_of_air() {
  const double pillars = 12 * kSlabThickness * kSlabThickness;
  const double inside_parapets = kCourt + 2 * kSlabThickness;
  const double behind_parapets = kWidth * kWidth - inside_parapets * inside_parapets + kCourt * kCourt;
  return (kWidth * kWidth - pillars) * (kGroundCeiling + kUpperCeiling - kParapetTop) +
         behind_parapets * (kParapetTop - kUpperFloor) +
         kCourt * kCourt * (kUpperFloor - kGroundCeiling + kHeight - kUpperCeiling);
}

TEST(Patio, IsWatertightUnderItsCanopy) {
  for (const Index patches : {0, 1508, 5000}) {
    const PatchMesh mesh = make_patches(built_in_scene("patio:sky=closed"), {.patches = patches});
    EXPECT_TRUE(mesh.topology.enclosure);
    EXPECT_FALSE(mesh.topology.convex);
    EXPECT_NEAR(mesh.topology.volume, -volume_of_air(), 1e-9);
    EXPECT_EQ(unmatched_edges(mesh), 0);
    EXPECT_NEAR(area_by_group(mesh).at("sky"), kCourt * kCourt, 1e-9);
  }
}

TEST(Patio, IsOpenAboveTheCourtOnly) {
  const PatchMesh& mesh = patio_of_squares();
  EXPECT_FALSE(mesh.topology.closed);
  EXPECT_EQ(unmatched_edges(mesh), static_cast<int>(4 * kCourt / kSide));
  EXPECT_FALSE(area_by_group(mesh).contains("sky"));
}

// The check can fail: a face the other way round, or one that is missing.
TEST(Patio, IsNotWatertightWithAFlippedOrMissingFace) {
  const Scene whole = built_in_scene("patio:sky=closed");
  for (std::size_t f = 0; f < whole.faces.size(); f += 41) {
    Scene flipped = whole, missing = whole;
    std::reverse(flipped.faces[f].corners.begin(), flipped.faces[f].corners.end());
    missing.faces.erase(missing.faces.begin() + static_cast<std::ptrdiff_t>(f));
    EXPECT_FALSE(topology(flipped).closed) << f;
    EXPECT_FALSE(topology(missing).closed) << f;
  }
}

using GridPoint = std::array<long, 3>;

/// Centres of the squares, in half sides. All lie on one grid, so that squares that overlap share theirs,
/// whichever way they look.
std::set<GridPoint> centres_of_squares(const PatchMesh& mesh) {
  std::set<GridPoint> points;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Vector3 point = mesh.centroid.col(i) / (0.5 * kSide);
    points.insert({std::lround(point.x()), std::lround(point.y()), std::lround(point.z())});
    EXPECT_LE((point - point.array().round().matrix()).norm(), 1e-9);
  }
  return points;
}

TEST(Patio, HasNoOverlappingFaces) {
  EXPECT_EQ(centres_of_squares(patio_of_squares()).size(), static_cast<std::size_t>(kSquares));
}

// The check can fail: the back of one face as a second surface.
TEST(Patio, OverlappingFacesWouldBeFound) {
  Scene scene = built_in_scene("patio");
  Face twin = scene.faces.front();
  std::reverse(twin.corners.begin(), twin.corners.end());
  scene.faces.push_back(twin);
  const PatchMesh mesh = make_patches(scene, {.edge = kSide});
  EXPECT_GT(mesh.patch_count(), kSquares);
  EXPECT_EQ(centres_of_squares(mesh).size(), static_cast<std::size_t>(kSquares));
}

TEST(Patio, LooksTheSameFromAllFourSides) {
  const std::set<GridPoint> centres = centres_of_squares(patio_of_squares());
  const long width = std::lround(kWidth / (0.5 * kSide));
  for (const GridPoint& point : centres)
    ASSERT_TRUE(centres.contains({width - point[2], point[1], point[0]}) &&
                centres.contains({width - point[0], point[1], point[2]}));
}

TEST(Patio, NamesGroupsByStoreyAndPart) {
  auto areas = area_by_group(patio_of_squares());
  const double pillars = 12 * kSlabThickness * kSlabThickness, galleries = kWidth * kWidth - kCourt * kCourt;
  EXPECT_NEAR(areas["court"], kCourt * kCourt, 1e-9);
  EXPECT_NEAR(areas["ground/floor"], galleries - pillars, 1e-9);
  EXPECT_NEAR(areas["ground/walls"], 4 * kWidth * kGroundCeiling, 1e-9);
  EXPECT_NEAR(areas["upper/walls"], 4 * kWidth * (kUpperCeiling - kUpperFloor), 1e-9);
  EXPECT_NEAR(areas["ground/pillars"], 12 * 4 * kSlabThickness * kGroundCeiling, 1e-9);
  for (const char* storey : {"ground", "upper"}) {
    EXPECT_NEAR(areas[fmt::format("{}/ceiling", storey)], galleries - pillars - 8 * kLampArea, 1e-9);
    EXPECT_NEAR(areas[fmt::format("{}/lintels", storey)], 4 * kCourt * kSlabThickness, 1e-9);
  }
  EXPECT_NEAR(areas["upper/floor"], galleries - 4 * kSlabThickness * (kCourt + kSlabThickness), 1e-9);
  EXPECT_NEAR(areas["upper/parapets"], 12 * kBay * (2 * (kParapetTop - kUpperFloor) + kSlabThickness), 1e-9);
  EXPECT_EQ(areas.size(), 12 + 16U) << "court, five parts a storey, parapets, lamps";
}

TEST(Patio, IsLitBySixteenLampsInTheCeilings) {
  const PatchMesh& mesh = patio_of_squares();
  auto areas = area_by_group(mesh);
  for (int lamp = 1; lamp <= 16; ++lamp) EXPECT_NEAR(areas[fmt::format("lamp{}", lamp)], kLampArea, 1e-9);
  for (Index i = 0; i < kSquares; ++i) {
    const std::string& group = group_name(mesh, i);
    const bool lamp = group.starts_with("lamp");
    ASSERT_EQ(mesh.emission.row(i).minCoeff() > 0, lamp) << group;
    ASSERT_TRUE(lamp || mesh.emission.row(i).isZero()) << group;
    if (!lamp) continue;
    ASSERT_EQ(mesh.normal(1, i), -1) << group;
    ASSERT_NEAR(mesh.centroid(1, i), std::stoi(group.substr(4)) <= 8 ? kGroundCeiling : kUpperCeiling, 1e-12);
  }
}

}  // namespace
}  // namespace radiosity
