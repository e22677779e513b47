#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/scene_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace radiosity {
namespace {

Scene cube() {
  return built_in_scene("cube");
}

void turn_over(Face& face) {
  std::reverse(face.corners.begin(), face.corners.begin() + face.corner_count);
}

TEST(Topology, TellsInsideFromOutside) {
  Scene scene = cube();
  for (Face& face : scene.faces) turn_over(face);
  const Topology outside = topology(scene);
  EXPECT_TRUE(outside.closed);
  EXPECT_NEAR(outside.volume, 1, 1e-14);
  EXPECT_FALSE(outside.enclosure);
  EXPECT_FALSE(outside.convex);
}

TEST(Topology, SeesAMissingAndAFlippedFace) {
  Scene missing = cube(), flipped = cube();
  missing.faces.pop_back();
  turn_over(flipped.faces.front());
  EXPECT_FALSE(topology(missing).closed);
  EXPECT_FALSE(topology(flipped).closed);
  EXPECT_TRUE(topology(missing).convex);  // still nothing that could stand between two points
}

TEST(Topology, AllowsEdgesThatMeetSeveralShorterOnes) {
  // The floor in three strips, the walls whole.
  SceneBuilder builder("strips");
  Scene scene = cube();
  scene.faces.erase(scene.faces.begin());
  const auto vertex = [&](double x, double z) {
    scene.vertices.emplace_back(x, 0, z);
    return static_cast<int>(scene.vertices.size()) - 1;
  };
  const double third = 1.0 / 3;
  for (int k = 0; k < 3; ++k)
    scene.faces.push_back(
        {{vertex(k * third, 0), vertex(k * third, 1), vertex((k + 1) * third, 1), vertex((k + 1) * third, 0)},
         4,
         0,
         0});
  EXPECT_TRUE(topology(scene).enclosure);
  scene.faces.pop_back();
  EXPECT_FALSE(topology(scene).closed);
}

TEST(Topology, WeldsVerticesThatAreWrittenTwice) {
  Scene scene = cube();
  std::vector<Vector3> vertices;
  for (Face& face : scene.faces)
    for (int k = 0; k < 4; ++k) {
      vertices.push_back(corner(scene, face, k) + Vector3::Constant(1e-9 * k));
    }
  scene.vertices = vertices;
  for (std::size_t f = 0; f < 6; ++f)
    for (int k = 0; k < 4; ++k)
      scene.faces[f].corners[static_cast<std::size_t>(k)] = static_cast<int>(4 * f) + k;
  EXPECT_TRUE(topology(scene).closed);
}

TEST(Topology, SeesAGapOfOneThousandth) {
  Scene scene = cube();
  scene.vertices.push_back(corner(scene, scene.faces[0], 0) + Vector3(0, 0.001, 0));
  scene.faces[0].corners[0] = static_cast<int>(scene.vertices.size()) - 1;
  EXPECT_FALSE(topology(scene).closed);
}

TEST(Topology, HoldsAtAnyScaleAndPlace) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double offset : {0.0, 1e5}) {
      Scene scene = cube();
      for (Vector3& vertex : scene.vertices) vertex = scale * (vertex + Vector3::Constant(offset));
      const Topology result = topology(scene);
      EXPECT_TRUE(result.enclosure && result.convex) << scale << " " << offset;
      EXPECT_NEAR(result.volume / (scale * scale * scale), -1, 1e-9);
    }
}

TEST(Topology, IsOpenForNothing) {
  EXPECT_FALSE(topology(Scene{}).closed);
}

TEST(TwoSided, GivesEachFaceATwin) {
  const Scene scene = cube();
  const Scene both = two_sided(scene);
  ASSERT_EQ(both.faces.size(), 12U);
  for (std::size_t f = 0; f < 6; ++f)
    EXPECT_LT((area_vector(both, both.faces[f]) + area_vector(both, both.faces[f + 6])).norm(), 1e-15);
  EXPECT_NEAR(topology(both).volume, 0, 1e-15);
}

}  // namespace
}  // namespace radiosity
