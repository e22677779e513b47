#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/built_in.hpp"
#include "scene/import.hpp"
#include "scene/scene_builder.hpp"
#include "scene/voxel_quads.hpp"
#include "scene/voxel_simplification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numbers>

namespace radiosity {
namespace {

double power(const PatchMesh& mesh) {
  return (mesh.area.transpose() * mesh.emission).sum();
}

double area_of(const std::vector<VoxelFragment>& fragments) {
  double sum = 0;
  for (const VoxelFragment& fragment : fragments) sum += fragment.area;
  return sum;
}

Eigen::AlignedBox3d unit_box() {
  return {Vector3::Zero(), Vector3::Ones()};
}

/// A square of side 1 about the origin, turned about y, cut into two triangles: the second emits 3 W/m^2.
Scene turned_square(double degrees) {
  SceneBuilder builder("turned square");
  const int dark = builder.material({"dark", Color::Constant(0.2), Color::Zero()});
  const int lamp = builder.material({"lamp", Color::Constant(0.6), Color::Constant(3)});
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Vector3::UnitY());
  const auto at = [&](double x, double y) { return Vector3(turn * Vector3(x, y, 0)); };
  builder.face({at(-.5, -.5), at(.5, -.5), at(.5, .5)}, dark, builder.group("dark"));
  builder.face({at(-.5, -.5), at(.5, .5), at(-.5, .5)}, lamp, builder.group("lamp"));
  return builder.scene();
}

class VoxelFragments : public testing::TestWithParam<const char*> {};

TEST_P(VoxelFragments, SumUpToTheAreaOfEachPatch) {
  const PatchMesh mesh = make_patches(built_in_scene(GetParam()));
  Eigen::AlignedBox3d box;
  for (const Vector3& vertex : mesh.vertices) box.extend(vertex);
  for (const double part : {0.9, 0.31, 0.077}) {
    const VoxelGrid grid(box, part * box.sizes().maxCoeff());
    Eigen::VectorXd area = Eigen::VectorXd::Zero(mesh.patch_count());
    for (const VoxelFragment& fragment : cut_into_voxels(mesh, grid)) {
      area[fragment.patch] += fragment.area;
      const Eigen::Array3i cell = grid.cell_of(fragment.extent.center());
      EXPECT_LT(fragment.extent.sizes().cwiseQuotient(grid.cell()).maxCoeff(), 1 + 1e-5);
      if ((fragment.extent.sizes().array() > 1e-5 * grid.cell().array())
              .all())  // else it may lie in a border
      {
        EXPECT_EQ(grid.number(cell), fragment.cell);
      }
    }
    EXPECT_LT((area - mesh.area).cwiseAbs().cwiseQuotient(mesh.area).maxCoeff(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, VoxelFragments,
                         testing::Values("cube", "cornell-box-closed", "sphere-cavity", "clutter"));

TEST(VoxelGrid, FitsItsBox) {
  const VoxelGrid grid({Vector3(1, 2, 3), Vector3(2, 2, 5.1)}, 0.3);
  EXPECT_EQ(grid.counts().x(), 3);
  EXPECT_EQ(grid.counts().y(), 1);
  EXPECT_EQ(grid.counts().z(), 7);
  EXPECT_EQ(grid.plane(2, 0), 3);
  EXPECT_EQ(grid.plane(2, 7), 5.1);
  EXPECT_EQ(grid.cell_of({9, 9, 9}).x(), 2);
}

TEST(VoxelGrid, GivesABorderToTheCellOnItsFront) {
  const VoxelGrid grid(unit_box(), 0.25);
  EXPECT_EQ(grid.range(0, 0.5, 0.5, 1), std::pair(2, 2));
  EXPECT_EQ(grid.range(0, 0.5, 0.5, -1), std::pair(1, 1));
  EXPECT_EQ(grid.range(0, 0.5 + 1e-8, 0.5 + 1e-8, -1), std::pair(1, 1));
  EXPECT_EQ(grid.range(0, 0.5 - 1e-8, 0.5 + 1e-8, 1), std::pair(2, 2));
  EXPECT_EQ(grid.range(0, 0, 0, -1), std::pair(0, 0));
  EXPECT_EQ(grid.range(0, 1, 1, 1), std::pair(3, 3));
  EXPECT_EQ(grid.range(0, 0.3, 0.8, 1), std::pair(1, 3));
}

TEST(VoxelSimplification, MakesEqualPatchesOfACube) {
  const PatchMesh cube = make_patches(built_in_scene("cube"));
  const SimplifiedScene simplified = simplify_to_voxels(cube, 600);
  const PatchMesh& mesh = *simplified.mesh;
  ASSERT_EQ(mesh.patch_count(), 600);
  EXPECT_LT((mesh.area.array() - 0.01).abs().maxCoeff(), 1e-15);
  EXPECT_TRUE(mesh.topology.closed);  // no gaps, no overlaps
  EXPECT_TRUE(mesh.topology.enclosure);
  EXPECT_TRUE(mesh.topology.convex);
  // Facing inwards, emission on the ceiling only.
  for (Index i = 0; i < 600; ++i) {
    EXPECT_GT(mesh.normal.col(i).dot(Vector3::Constant(0.5) - mesh.centroid.col(i)), 0.49);
    EXPECT_EQ(mesh.scene->groups[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group)] ==
                  "ceiling",
              mesh.emission(i, 0) > 0);
  }
}

TEST(VoxelSimplification, ReproducesACubeWhateverItsTriangles) {
  Scene triangles = built_in_scene("cube");
  std::vector<Face> halves;
  for (const Face& face : triangles.faces) {
    Face half = face;
    half.corner_count = 3;
    halves.push_back(half);
    half.corners = {face.corners[0], face.corners[2], face.corners[3], 0};
    halves.push_back(half);
  }
  triangles.faces = halves;
  const PatchMesh mesh = *simplify_to_voxels(make_patches(triangles), 600).mesh;
  ASSERT_EQ(mesh.patch_count(), 600);
  EXPECT_LT((mesh.area.array() - 0.01).abs().maxCoeff(), 1e-14);
  EXPECT_TRUE(mesh.topology.closed);
}

TEST(VoxelSimplification, KeepsASlopeWithItsAreaAndPower) {
  for (const double degrees : {0.0, 17.0, 30.0, 44.0}) {
    const PatchMesh square = make_patches(turned_square(degrees));
    const PatchMesh mesh = *simplify_to_voxels(square, 50).mesh;
    EXPECT_NEAR(power(mesh), power(square), 1e-12) << degrees;
    EXPECT_NEAR(mesh.area.sum(), 1, 1e-5) << degrees;
    EXPECT_NEAR(mesh.area.dot(mesh.reflectance.col(0)) / mesh.area.sum(), 0.4, 1e-5) << degrees;
    const Vector3 normal = square.normal.col(0);
    EXPECT_LT((mesh.normal.colwise() - normal).norm(), 1e-5) << degrees;
    EXPECT_LT((normal.transpose() * mesh.centroid).cwiseAbs().maxCoeff(), 1e-9) << "a stair, not a slope";
    // Level quads in place of tilted ones would have no more than the projection.
    const double projection = std::cos(degrees * std::numbers::pi / 180);
    EXPECT_NEAR(mesh.area.dot(mesh.normal.row(2).cwiseAbs().transpose()), projection, 1e-5) << degrees;
  }
}

TEST(VoxelSimplification, TiltsNothingBeyondItsFragments) {
  for (const char* name : {"sphere-cavity", "bowl"}) {
    const PatchMesh original = make_patches(built_in_scene(name));
    const SimplifiedScene simplified = simplify_to_voxels(original, 250);
    std::map<std::uint64_t, Eigen::AlignedBox3d> extents;
    for (const VoxelFragment& fragment : simplified.fragments)
      extents[quad_key(fragment)].extend(fragment.extent);
    auto extent = extents.begin();
    for (const VoxelQuad& quad : voxel_quads(original, simplified.grid, simplified.fragments)) {
      const int axis = axis_of(static_cast<int>(extent->first % 6));
      for (const Vector3& corner : quad.corners) {
        EXPECT_LE(corner[axis], extent->second.max()[axis] + 1e-9) << name;
        EXPECT_GE(corner[axis], extent->second.min()[axis] - 1e-9) << name;
      }
      ++extent;
    }
  }
}

TEST(VoxelSimplification, LeavesLevelWhatIsLevel) {
  const auto least_cosine = [](const char* name) {
    const PatchMesh mesh = *simplify_to_voxels(make_patches(built_in_scene(name)), 250).mesh;
    return mesh.normal.cwiseAbs().colwise().maxCoeff().minCoeff();
  };
  EXPECT_EQ(least_cosine("rooms"), 1);
  EXPECT_LT(least_cosine("cornell-box-closed"), 0.99) << "its blocks stand askew";
}

TEST(VoxelSimplification, OfTwoLayersKeepsOneWithThePowerOfBoth) {
  SceneBuilder builder("two layers");
  const int lamp = builder.material({"lamp", Color::Constant(0.5), Color::Constant(2)});
  for (const double z : {0.2, 0.4})
    builder.face({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, lamp, builder.group("lamp"));
  const PatchMesh layers = make_patches(builder.scene());
  const PatchMesh mesh = *simplify_to_voxels(layers, VoxelGrid(unit_box(), 1)).mesh;
  ASSERT_EQ(mesh.patch_count(), 1);
  EXPECT_NEAR(mesh.area[0], 1, 1e-15);
  EXPECT_NEAR(power(mesh), power(layers), 1e-12);  // the mean of their emissions would keep half
}

TEST(VoxelSimplification, ConservesPowerInEveryScene) {
  for (const char* name : {"cornell-box", "sphere-cavity", "clutter", "rooms"}) {
    const PatchMesh original = make_patches(built_in_scene(name));
    const PatchMesh mesh = *simplify_to_voxels(original, 300).mesh;
    EXPECT_EQ(mesh.channels(), original.channels());
    EXPECT_NEAR(power(mesh) / power(original), 1, 1e-12) << name;
    EXPECT_LE(mesh.area.sum(), original.area.sum() * (1 + 1e-9)) << name;
    EXPECT_LE(mesh.reflectance.maxCoeff(), original.reflectance.maxCoeff() * (1 + 1e-12));
    EXPECT_GE(mesh.reflectance.minCoeff(), original.reflectance.minCoeff() * (1 - 1e-12));
  }
}

TEST(VoxelSimplification, MeansColoursByArea) {
  const PatchMesh square = make_patches(turned_square(0));
  const PatchMesh mesh =
      *simplify_to_voxels(square, VoxelGrid({Vector3::Constant(-.5), Vector3::Constant(.5)}, 1)).mesh;
  ASSERT_EQ(mesh.patch_count(), 1);
  EXPECT_NEAR(mesh.area[0], 1, 1e-15);
  EXPECT_NEAR(mesh.reflectance(0, 0), 0.4, 1e-15);
  EXPECT_NEAR(mesh.emission(0, 0), 1.5, 1e-15);
}

TEST(VoxelSimplification, KeepsTheSidesOfAThinWallApart) {
  SceneBuilder builder("thin wall");
  const int red = builder.material({"red", Color(0.8, 0.1, 0.1), Color::Zero()});
  const int green = builder.material({"green", Color(0.1, 0.8, 0.1), Color::Zero()});
  builder.face({{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}}, red, builder.group("front"));
  builder.face({{0, 1, 0.49}, {1, 1, 0.49}, {1, 0, 0.49}, {0, 0, 0.49}}, green, builder.group("back"));
  const PatchMesh mesh = *simplify_to_voxels(make_patches(builder.scene()), VoxelGrid(unit_box(), 1)).mesh;
  ASSERT_EQ(mesh.patch_count(), 2);
  for (Index i = 0; i < 2; ++i) {
    const bool front = mesh.normal(2, i) > 0;
    EXPECT_EQ(mesh.centroid(2, i), front ? 0.5 : 0.49);
    EXPECT_EQ(mesh.reflectance(i, 0), front ? 0.8 : 0.1);
    EXPECT_NEAR(mesh.area[i], 1, 1e-15);
  }
}

TEST(VoxelSimplification, TurnsNoWallInsideOut) {
  // A wall of two thicknesses with openings: the mean of its fronts (0.505) lies before that of its backs
  // (0.513), so that the two quads would look at each other.
  SceneBuilder builder("wall of two thicknesses");
  const int grey = builder.material({"grey", Color::Constant(0.5), Color::Zero()});
  const int group = builder.group("wall");
  const auto front = [&](double x, double from, double to) {
    builder.face({{x, from, 0}, {x, to, 0}, {x, to, 1}, {x, from, 1}}, grey, group);
  };
  const auto back = [&](double x, double from, double to) {
    builder.face({{x, from, 1}, {x, to, 1}, {x, to, 0}, {x, from, 0}}, grey, group);
  };
  front(0.5, 0, 0.5);
  front(0.53, 0.9, 1);
  back(0.49, 0, 0.2);
  back(0.52, 0.3, 1);
  const PatchMesh wall = make_patches(builder.scene());
  double before = 0, behind = 0;  // area-weighted offsets of the two sides
  for (Index i = 0; i < 4; ++i)
    (wall.normal(0, i) > 0 ? before : behind) +=
        wall.area[i] * wall.centroid(0, i) / (wall.normal(0, i) > 0 ? 0.6 : 0.9);
  ASSERT_LT(before, behind);
  const PatchMesh mesh = *simplify_to_voxels(wall, VoxelGrid(unit_box(), 1)).mesh;
  ASSERT_EQ(mesh.patch_count(), 2);
  EXPECT_EQ(mesh.centroid(0, 0), mesh.centroid(0, 1));
}

TEST(VoxelSimplification, LeavesRealSlitsOpen) {
  for (const double gap : {0.05, 1e-4}) {
    SceneBuilder builder("slit");
    const int grey = builder.material({"grey", Color::Constant(0.5), Color::Zero()});
    builder.face({{0.5, 0, 0}, {0.5, 1, 0}, {0.5, 1, 1}, {0.5, 0, 1}}, grey, builder.group("left"));
    const double x = 0.5 + gap;
    builder.face({{x, 0, 1}, {x, 1, 1}, {x, 1, 0}, {x, 0, 0}}, grey, builder.group("right"));
    const PatchMesh mesh = *simplify_to_voxels(make_patches(builder.scene()), VoxelGrid(unit_box(), 1)).mesh;
    EXPECT_NEAR(mesh.centroid(0, 1) - mesh.centroid(0, 0), gap > 1e-3 ? gap : 0, 1e-15);
  }
}

TEST(VoxelSimplification, OfAnEnclosureIsOne) {
  const PatchMesh sphere = make_patches(built_in_scene("sphere-cavity"));
  ASSERT_TRUE(sphere.topology.enclosure);
  const PatchMesh mesh = *simplify_to_voxels(sphere, 200).mesh;
  EXPECT_FALSE(mesh.topology.closed);  // cells cut corners of it
  EXPECT_TRUE(mesh.topology.enclosure);
  EXPECT_FALSE(simplify_to_voxels(make_patches(built_in_scene("open-box")), 200).mesh->topology.enclosure);
}

TEST(VoxelSimplification, BracketsTheWantedNumber) {
  const PatchMesh mesh = make_patches(built_in_scene("cornell-box-closed"));
  Index last = 0;
  for (const Index wanted : {1, 50, 200, 800, 3000}) {
    const Index found = simplify_to_voxels(mesh, wanted).mesh->patch_count();
    EXPECT_GT(found, last);
    if (wanted >= 50) {
      EXPECT_NEAR(static_cast<double>(found) / static_cast<double>(wanted), 1, 0.2) << wanted;
    }
    last = found;
  }
  EXPECT_EQ(simplify_to_voxels(make_patches(built_in_scene("cube")), 1).mesh->patch_count(), 6);
  EXPECT_THROW(simplify_to_voxels(mesh, 0), UsageError);
}

TEST(VoxelSimplification, DoesNotDependOnThreadsScaleOrOffset) {
  Scene scene = built_in_scene("clutter");
  const PatchMesh here = *simplify_to_voxels(make_patches(scene), 400).mesh;
  {
    const ThreadLimit one(1);
    EXPECT_EQ(simplify_to_voxels(make_patches(scene), 400).mesh->geometry_hash(), here.geometry_hash());
  }
  for (Vector3& vertex : scene.vertices) vertex = 1e3 * vertex + Vector3::Constant(1e5);
  const PatchMesh there = *simplify_to_voxels(make_patches(scene), 400).mesh;
  ASSERT_EQ(there.patch_count(), here.patch_count());
  EXPECT_LT((there.area * 1e-6 - here.area).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(VoxelSimplification, TakesADirtySceneOfOthers) {
  const std::filesystem::path file = std::filesystem::path(RADIOSITY_SOURCE_DIR) /
                                     "../shared/scenes/citygml-lod4-building/citygml-lod4-building.obj";
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no " << file << ": scenes of others are not part of the project";
  const PatchMesh original = make_patches(import_scene(file));
  const SimplifiedScene simplified = simplify_to_voxels(original, 1000);
  EXPECT_NEAR(static_cast<double>(simplified.mesh->patch_count()), 1000, 100);
  EXPECT_NEAR(area_of(simplified.fragments) / original.area.sum(), 1, 1e-9);
}

}  // namespace
}  // namespace radiosity
