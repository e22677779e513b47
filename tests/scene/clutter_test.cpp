#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace radiosity {
namespace {

/// A box as what it covers from above, and its range of heights.
struct Footprint {
  Polygon top;
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
};

std::vector<Footprint> footprints(const Scene& scene) {
  std::vector<Footprint> boxes(scene.groups.size() - 6);  // after the six walls
  for (const Face& face : scene.faces) {
    if (face.group < 6) continue;
    Footprint& box = boxes[static_cast<std::size_t>(face.group - 6)];
    for (int k = 0; k < 4; ++k) {
      box.low = std::min(box.low, corner(scene, face, k).y());
      box.high = std::max(box.high, corner(scene, face, k).y());
    }
    if (area_vector(scene, face).normalized().y() < 0.99) continue;
    for (int k = 0; k < 4; ++k) {
      Vector3 point = corner(scene, face, k);
      point.y() = 0;
      box.top.push_back(point);
    }
  }
  return boxes;
}

bool disjoint_and_inside(const Scene& scene) {
  const std::vector<Footprint> boxes = footprints(scene);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].top.size() != 4 || boxes[i].low <= 0 || boxes[i].high >= 1) return false;
    for (const Vector3& point : boxes[i].top)
      if (point.x() <= 0 || point.x() >= 1 || point.z() <= 0 || point.z() >= 1) return false;
    for (std::size_t k = 0; k < i; ++k)
      if (boxes[i].low < boxes[k].high && boxes[k].low < boxes[i].high &&
          overlap(boxes[i].top, boxes[k].top, Vector3::UnitY(), 1e-12))
        return false;
  }
  return true;
}

TEST(Clutter, HasDisjointBoxesInsideARoom) {
  for (const char* spec : {"clutter", "clutter:seed=2", "clutter:seed=3,boxes=40", "clutter:boxes=100"}) {
    const Scene scene = built_in_scene(spec);
    EXPECT_TRUE(disjoint_and_inside(scene)) << spec;
    EXPECT_TRUE(topology(scene).enclosure) << spec;
  }
}

// The check can fail.
TEST(Clutter, IsNotDisjointWhereABoxIsPutOnAnother) {
  Scene scene = built_in_scene("clutter");
  const Vector3 shift = corner(scene, scene.faces[12], 0) - corner(scene, scene.faces[6], 0);
  Scene moved = scene;
  for (int k = 0; k < 8; ++k) moved.vertices[static_cast<std::size_t>(8 + k)] += 0.9 * shift;
  EXPECT_TRUE(disjoint_and_inside(scene));
  EXPECT_FALSE(disjoint_and_inside(moved));
}

TEST(Clutter, IsTheMeasuredSceneInSize) {
  const PatchMesh mesh = make_patches(built_in_scene("clutter"), {.patches = 3552});
  EXPECT_EQ(mesh.scene->groups.size(), 18U);
  EXPECT_NEAR(static_cast<double>(mesh.patch_count()), 3552, 36);
  EXPECT_EQ(unmatched_edges(mesh), 0);
  EXPECT_EQ(mesh.channels(), 3);
  auto areas = area_by_group(mesh);
  for (const char* wall : {"floor", "ceiling", "left", "right", "back", "front"})
    EXPECT_NEAR(areas[wall], 1, 1e-11);
}

TEST(Clutter, IsTheSameForTheSameSeedOnly) {
  const auto vertices = [](const char* spec) { return built_in_scene(spec).vertices; };
  EXPECT_EQ(vertices("clutter:seed=5"), vertices("clutter:boxes=12,seed=5"));
  EXPECT_NE(vertices("clutter:seed=5"), vertices("clutter:seed=6"));
}

TEST(Clutter, IsTheEmptyCubeWithoutBoxes) {
  const PatchMesh mesh = make_patches(built_in_scene("clutter:boxes=0,reflectance=0.9"));
  EXPECT_EQ(mesh.patch_count(), 6);
  EXPECT_TRUE(mesh.topology.convex);
  EXPECT_EQ(mesh.reflectance(0, 0), 0.9);
  EXPECT_GT(mesh.reflectance(2, 0), 5 * mesh.reflectance(2, 1));  // the left wall is red
  EXPECT_GT(mesh.reflectance(3, 1), 3 * mesh.reflectance(3, 0));  // the right one is green
}

}  // namespace
}  // namespace radiosity
