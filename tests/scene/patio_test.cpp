#include "mesh_checks.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace radiosity {
namespace {

TEST(Patio, ComesInTheDocumentsNumberOfPatches) {
  const Scene scene = built_in_scene("patio");
  for (const Index m : {1, 2, 8})
    EXPECT_EQ(make_patches(scene, {.patches = 377 * m * m}).patch_count(), 377 * m * m);
  EXPECT_EQ(make_patches(scene, {.patches = 24128}).patch_count(), 24128);
}

TEST(Patio, IsOpenOnlyToTheSky) {
  const Scene scene = built_in_scene("patio");
  const PatchMesh mesh = make_patches(scene, {.patches = 377});
  EXPECT_FALSE(mesh.topology.closed);
  // What is missing is the court's 5.4 m square of sky: 3 cells on each of its sides.
  EXPECT_EQ(unmatched_edges(mesh), 12);
  Vector3 missing = Vector3::Zero();
  for (const Face& face : scene.faces) missing += area_vector(scene, face);
  EXPECT_NEAR((missing - Vector3(0, 5.4 * 5.4, 0)).norm(), 0, 1e-12);
}

TEST(Patio, HasLampsToBeSwitchedOneByOne) {
  const Scene scene = built_in_scene("patio");
  std::set<std::string> lit;
  for (const Face& face : scene.faces)
    if (scene.materials[static_cast<std::size_t>(face.material)].emission.maxCoeff() > 0)
      lit.insert(scene.groups[static_cast<std::size_t>(face.group)]);
  EXPECT_EQ(lit, (std::set<std::string>{"lamp1", "lamp2", "lamp3", "lamp4"}));
}

TEST(Patio, FacesOfOnePlaneDoNotOverlap) {
  const Scene scene = built_in_scene("patio");
  std::vector<Polygon> polygons;
  polygons.reserve(scene.faces.size());
  for (const Face& face : scene.faces)
    polygons.push_back(
        {corner(scene, face, 0), corner(scene, face, 1), corner(scene, face, 2), corner(scene, face, 3)});
  for (std::size_t i = 0; i < polygons.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Vector3 normal = area_vector(polygons[i]).normalized();
      const auto in_plane = [&](const Vector3& point) {
        return std::abs(normal.dot(point - polygons[i][0])) < 1e-9;
      };
      if (!std::all_of(polygons[k].begin(), polygons[k].end(), in_plane)) continue;
      Polygon other = polygons[k];
      if (area_vector(other).dot(normal) < 0) std::reverse(other.begin(), other.end());
      EXPECT_FALSE(overlap(polygons[i], other, normal, 1e-9)) << i << " " << k;
    }
}

}  // namespace
}  // namespace radiosity
