#include "experiments/area_light.hpp"
#include "experiments/disc_cover.hpp"
#include "experiments/lights.hpp"
#include "experiments/point_light.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "render/bounding_box.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace radiosity::testing {
namespace {

PatchMesh built_in_mesh(const std::string& name, Index patches) {
  return make_patches(built_in_scene(name), {.patches = patches});
}

LightSet draw(const PatchMesh& mesh, const std::string& counts, std::uint64_t seed = 1) {
  SilentMonitor monitor;
  return draw_lights(mesh, LightCounts::parse(counts), seed, monitor);
}

std::string refusal(const std::string& counts) {
  try {
    LightCounts::parse(counts);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(LightCounts, AreParsedOrRefusedWithTheirOwnWords) {
  const LightCounts counts = LightCounts::parse("patch:3,area:10");
  EXPECT_EQ(counts.area, 10);
  EXPECT_EQ(counts.point, 0);
  EXPECT_EQ(counts.patch, 3);
  EXPECT_EQ(counts.total(), 13);
  for (const char* wrong :
       {"", "area", "area:", "area:x", "area:-1", "area:1.5", "area:1,", "area:100001", "spot:3"})
    EXPECT_NE(refusal(wrong), "") << wrong;
  EXPECT_NE(refusal("spot:3").find("spot:3"), std::string::npos);
  EXPECT_NE(refusal("area:1,area:2").find("twice"), std::string::npos);
}

TEST(DiscCover, KnownAreas) {
  using Polygon = std::vector<Eigen::Vector2d>;
  const Polygon square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  EXPECT_NEAR(disc_polygon_area(square, 0.5), std::numbers::pi / 4, 1e-14);
  EXPECT_NEAR(disc_polygon_area(square, 2), 4, 1e-14);
  const Polygon quarter = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
  EXPECT_NEAR(disc_polygon_area(quarter, 1), std::numbers::pi / 4, 1e-14);
  const Polygon away = {{5, 5}, {6, 5}, {6, 6}};
  EXPECT_NEAR(disc_polygon_area(away, 1), 0, 1e-14);
  const Polygon half = {{0, -4}, {4, -4}, {4, 4}, {0, 4}};
  EXPECT_NEAR(disc_polygon_area(half, 1.5), std::numbers::pi * 2.25 / 2, 1e-13);
}

TEST(DiscCover, RandomTrianglesAgainstAFineGrid) {
  RandomStream random(4);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<Eigen::Vector2d, 3> triangle;
    for (Eigen::Vector2d& corner : triangle) corner = {random.uniform(-2, 2), random.uniform(-2, 2)};
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    if (cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0) std::swap(triangle[1], triangle[2]);
    constexpr int cells = 600;
    int inside = 0;
    for (int i = 0; i < cells * cells; ++i) {
      const int row = i / cells, column = i % cells;
      const Eigen::Vector2d point(-1 + 2 * (column + 0.5) / cells, -1 + 2 * (row + 0.5) / cells);
      bool in = point.squaredNorm() < 1;
      for (std::size_t k = 0; k < 3; ++k)
        in = in && cross(triangle[(k + 1) % 3] - triangle[k], point - triangle[k]) > 0;
      inside += in ? 1 : 0;
    }
    const double grid = 4.0 * inside / (cells * cells);
    EXPECT_NEAR(disc_polygon_area(triangle, 1), grid, 0.01) << trial;
  }
}

TEST(AreaLights, CoverExactlyTheDiscOnOneWall) {
  const PatchMesh mesh = built_in_mesh("cube", 600);
  const LightSet set = draw(mesh, "area:40");
  int complete = 0;
  for (std::size_t k = 0; k < set.lights.size(); ++k) {
    const Light& light = set.lights[k];
    const Eigen::VectorXd E = set.emission.col(static_cast<Index>(k) * mesh.channels());
    EXPECT_GE(light.radius, 0.02 * std::sqrt(3));
    EXPECT_LE(light.radius, 0.15 * std::sqrt(3));
    EXPECT_GE(E.minCoeff(), 0);
    EXPECT_LE(E.maxCoeff(), 1);
    const int group = mesh.patches[static_cast<std::size_t>(light.patch)].group;
    double to_edge = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = light.position[axis];
      if (std::min(x, 1 - x) > 1e-9) to_edge = std::min({to_edge, x, 1 - x});
    }
    for (Index i = 0; i < mesh.patch_count(); ++i)
      EXPECT_TRUE(mesh.patches[static_cast<std::size_t>(i)].group == group || E[i] == 0);
    const double disc = std::numbers::pi * light.radius * light.radius;
    if (to_edge > light.radius) {
      EXPECT_NEAR(mesh.area.dot(E), disc, 1e-12);
      ++complete;
    } else {
      EXPECT_LT(mesh.area.dot(E), disc);
      EXPECT_GT(mesh.area.dot(E), 0.25 * disc - 1e-12);
    }
  }
  EXPECT_GE(complete, 10);
}

TEST(AreaLights, CountingCentroidsInsteadOfAreaIsNoticed) {
  const PatchMesh mesh = built_in_mesh("cube", 600);
  const Light light = draw(mesh, "area:1").lights.front();
  const int group = mesh.patches[static_cast<std::size_t>(light.patch)].group;
  double counted = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    if (mesh.patches[static_cast<std::size_t>(i)].group == group &&
        (mesh.centroid.col(i) - light.position).norm() < light.radius)
      counted += mesh.area[i];
  EXPECT_GT(std::abs(counted - mesh.area.dot(area_light_cover(mesh, light))), 1e-6);
}

TEST(AreaLights, CentresAreUniformByArea) {
  const PatchMesh mesh = built_in_mesh("cornell-box-closed", 300);
  Eigen::VectorXd hits = Eigen::VectorXd::Zero(static_cast<Index>(mesh.scene->groups.size()));
  Eigen::VectorXd areas = hits;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    areas[mesh.patches[static_cast<std::size_t>(i)].group] += mesh.area[i];
  RandomStream random(3);
  constexpr int draws = 20000;
  for (int k = 0; k < draws; ++k) {
    const Light light = draw_area_light(mesh, random);
    hits[mesh.patches[static_cast<std::size_t>(light.patch)].group] += 1;
  }
  for (Index g = 0; g < hits.size(); ++g) {
    const double share = areas[g] / areas.sum();
    EXPECT_NEAR(hits[g] / draws, share, 5 * std::sqrt(share / draws))
        << mesh.scene->groups[static_cast<std::size_t>(g)];
  }
}

TEST(PatchLights, AreOnePatchOfOneWatt) {
  const PatchMesh mesh = built_in_mesh("cornell-box", 200);
  const LightSet set = draw(mesh, "patch:20");
  ASSERT_EQ(set.emission.cols(), 20 * mesh.channels());
  for (Index j = 0; j < set.emission.cols(); ++j) {
    EXPECT_EQ(set.emission.col(j).sum(), 1);
    EXPECT_EQ(set.emission(set.lights[static_cast<std::size_t>(j / mesh.channels())].patch, j), 1);
  }
}

TEST(PointLights, AllTheirLightArrivesInAClosedRoom) {
  const PatchMesh mesh = built_in_mesh("cube", 150);
  const LightSet set = draw(mesh, "point:10");
  for (std::size_t k = 0; k < set.lights.size(); ++k) {
    const Eigen::VectorXd H =
        set.emission.col(static_cast<Index>(k) * mesh.channels()).cwiseQuotient(mesh.reflectance.col(0));
    EXPECT_NEAR(mesh.area.dot(H), 1, 1e-9);  // 1 W
    EXPECT_LE((set.lights[k].position - Vector3::Constant(0.5)).cwiseAbs().maxCoeff(), 0.4);
  }
}

TEST(PointLights, ShadowsLoseNoLight) {
  const PatchMesh mesh = built_in_mesh("cornell-box-closed", 1200);
  const PointLights points(mesh);
  RandomStream random(8);
  for (int k = 0; k < 8; ++k) {
    const auto [light, H] = points.draw(random);
    EXPECT_NEAR(mesh.area.dot(H), 1, 0.02) << light.position.transpose();
    EXPECT_EQ((H.array() == 0).any(), true) << "the boxes must cast shadows, or show the light their backs";
  }
}

TEST(PointLights, WithoutShadowsTheSumIsTooLarge) {
  const PatchMesh mesh = built_in_mesh("cornell-box-closed", 1200);
  const PointLights points(mesh);
  RandomStream random(8);
  const Light light = points.draw(random).first;
  double sum = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) sum += front_solid_angle(mesh, i, light.position);
  EXPECT_GT(sum / (4 * std::numbers::pi), 1.02);
}

TEST(PointLights, AScreenCastsItsShadowExactlyWhereItStands) {
  Scene scene;
  scene.name = "screen";
  scene.materials = {{}};
  scene.groups = {"floor", "screen"};
  const auto add_square = [&](double half, double height, int group) {
    const int first = static_cast<int>(scene.vertices.size());
    scene.vertices.insert(
        scene.vertices.end(),
        {{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}});
    scene.faces.push_back({{first, first + 1, first + 2, first + 3}, 4, 0, group});
  };
  add_square(2, 0, 0);
  add_square(0.5, 1, 1);
  const PatchMesh mesh = make_patches(scene, {.edge = 0.2});
  const Eigen::VectorXd H = PointLights(mesh).irradiance({0, 0, 2}, 1);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    if (mesh.patches[static_cast<std::size_t>(i)].group != 0) continue;
    const double x =
        mesh.centroid.col(i).cwiseAbs().maxCoeff();  // the shadow of the screen is the square |x|, |y| < 1
    EXPECT_TRUE(x > 0.85 || H[i] == 0) << mesh.centroid.col(i).transpose();
    if (x < 1.15) continue;
    const double squared = (mesh.centroid.col(i) - Vector3(0, 0, 2)).squaredNorm();
    const double expected = 2 / (4 * std::numbers::pi * std::pow(squared, 1.5));
    EXPECT_NEAR(H[i], expected, 0.01 * expected) << mesh.centroid.col(i).transpose();
  }
}

TEST(PointLights, InsideASolidIsNoPlace) {
  const PatchMesh mesh = built_in_mesh("cornell-box-closed", 400);
  const PointLights points(mesh);
  for (std::size_t group = 0; group < mesh.scene->groups.size(); ++group) {
    if (mesh.scene->groups[group].find("block") == std::string::npos) continue;
    Eigen::AlignedBox3d box;
    for (Index i = 0; i < mesh.patch_count(); ++i)
      if (mesh.patches[static_cast<std::size_t>(i)].group == static_cast<int>(group))
        box.extend(Vector3(mesh.centroid.col(i)));
    RandomStream random(1);
    EXPECT_FALSE(points.outside_solids(box.center(), random)) << mesh.scene->groups[group];
    EXPECT_TRUE(points.outside_solids(box.center() + Vector3(0, 0.9 * box.sizes().y(), 0), random));
  }
  RandomStream random(1);
  EXPECT_FALSE(points.outside_solids(bounding_box(mesh).max() * 1.5, random)) << "behind the walls";
}

TEST(PointLights, ABlackSceneIsRefusedInsteadOfSearchedForever) {
  PatchMesh mesh = built_in_mesh("cube", 24);
  mesh.reflectance.setZero();
  EXPECT_THROW(draw(mesh, "point:1"), Error);
}

TEST(LightSets, DependOnTheSeedAndThePlaceOnly) {
  const PatchMesh mesh = built_in_mesh("cornell-box", 300);
  const LightSet set = draw(mesh, "area:3,point:2,patch:2");
  EXPECT_EQ(set.emission.cols(), 7 * mesh.channels());
  for (Index light = 0; light < 7; ++light)
    EXPECT_GT(set.emission.middleCols(light * mesh.channels(), mesh.channels()).norm(), 0);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(draw(mesh, "area:3,point:2,patch:2").emission, set.emission) << threads;
  }
  EXPECT_NE(draw(mesh, "area:3,point:2,patch:2", 2).emission, set.emission);
  const LightSet more = draw(mesh, "area:4,point:2,patch:2");
  EXPECT_EQ(more.emission.leftCols(3 * mesh.channels()), set.emission.leftCols(3 * mesh.channels()));
  EXPECT_EQ(more.emission.rightCols(4 * mesh.channels()), set.emission.rightCols(4 * mesh.channels()));
}

}  // namespace
}  // namespace radiosity::testing
