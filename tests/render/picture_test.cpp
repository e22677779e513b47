#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "render/camera_rays.hpp"
#include "render/picture.hpp"
#include "render/vertex_radiosity.hpp"
#include "rooms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace radiosity {
namespace {

using namespace test;

Picture draw(const PatchMesh& mesh, const Eigen::MatrixXd& B, const PictureOptions& options) {
  SilentMonitor monitor;
  return render_picture(mesh, B, options, monitor);
}

PatchMesh furnace_seen_from(const Vector3& position, const Vector3& target) {
  Scene scene = box_room({1, 1, 1});
  scene.camera = Camera{position, target, Vector3::UnitY(), 60};
  PatchMesh mesh = make_patches(scene, {.patches = 54});
  make_furnace(mesh, 0.5, 1);
  return mesh;
}

TEST(Picture, FurnaceLooksTheSameEverywhere) {
  const PatchMesh mesh = furnace_seen_from({0.3, 0.4, 0.2}, {1, 1, 0.9});
  const Eigen::MatrixXd B = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, 2);
  for (const bool interpolate : {false, true}) {
    const Picture picture = draw(mesh, B, {.width = 64, .height = 48, .interpolate = interpolate});
    ASSERT_EQ(picture.pixels.size(), 3U * 64 * 48);
    for (const float value : picture.pixels) ASSERT_NEAR(value, 2 / std::numbers::pi, 1e-6);
  }
}

TEST(Picture, ClosedRoomIsSeenFromOutside) {
  // The near wall is seen from behind and looked through: the far wall fills the middle, around it the room's
  // other walls.
  const PatchMesh mesh = furnace_seen_from({0.5, 0.5, 3}, {0.5, 0.5, 0});
  Eigen::MatrixXd B(mesh.patch_count(), 3);
  for (Index i = 0; i < mesh.patch_count(); ++i)
    B.row(i).setConstant(mesh.patches[static_cast<std::size_t>(i)].group + 1);
  const Picture picture = draw(mesh, B, {.width = 90, .height = 90, .supersampling = 1});
  const auto group_at = [&](int x, int y) {
    return static_cast<int>(std::lround(picture.pixel(x, y)[1] * std::numbers::pi)) - 1;
  };
  EXPECT_EQ(group_at(45, 45), 4);  // back
  EXPECT_EQ(group_at(29, 45), 0);  // left, at x = 0, to the left of the picture
  EXPECT_EQ(group_at(61, 45), 1);  // right
  EXPECT_EQ(group_at(45, 61), 2);  // floor below
  EXPECT_EQ(group_at(45, 29), 3);  // ceiling above
  EXPECT_EQ(group_at(2, 2), -1);   // beside the room: black
}

TEST(Picture, PointsProjectWhereTheCameraSeesThem) {
  const Camera camera{{1, 2, 5}, {1, 2, 0}, Vector3::UnitY(), 90};
  const CameraRays rays(camera, 200, 100);
  // 90 degrees from bottom to top: at distance 1, one unit up is the top edge; pixels are square.
  EXPECT_LT((rays.direction(100, 50) - Vector3(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((rays.direction(100, 0) - Vector3(0, 1, -1).normalized()).norm(), 1e-12);
  EXPECT_LT((rays.direction(100, 100) - Vector3(0, -1, -1).normalized()).norm(), 1e-12);
  EXPECT_LT((rays.direction(200, 50) - Vector3(2, 0, -1).normalized()).norm(), 1e-12);
  const Camera astray{{0, 5, 0}, {0, 0, 0}, Vector3::UnitY(), 40};
  EXPECT_THROW(CameraRays(astray, 10, 10), Error);
}

TEST(Picture, DefaultCameraSeesTheWholeScene) {
  for (const Scene& scene : {box_room({1, 1, 1}), box_room({4, 1, 2}), box_room({1, 3, 1})}) {
    PatchMesh mesh = make_patches(scene);
    const Eigen::MatrixXd B = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, std::numbers::pi);
    const Picture picture = draw(mesh, B, {.width = 100, .height = 100, .supersampling = 1});
    int lit = 0;
    int lit_on_edge = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x) {
        const bool seen = picture.pixel(x, y)[0] > 0;
        lit += seen ? 1 : 0;
        lit_on_edge += seen && (x == 0 || y == 0 || x == 99 || y == 99) ? 1 : 0;
      }
    EXPECT_GT(lit, 2000);
    EXPECT_EQ(lit_on_edge, 0);
  }
}

TEST(Picture, ThreadsDoNotMatter) {
  const PatchMesh mesh = furnace_seen_from({0.3, 0.4, 0.2}, {1, 1, 0.9});
  Eigen::MatrixXd B = Eigen::VectorXd::LinSpaced(mesh.patch_count(), 1, 2);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return draw(mesh, B, {.width = 50, .height = 40, .interpolate = true}).pixels;
  };
  EXPECT_EQ(with_threads(1), with_threads(4));
}

TEST(Picture, RefusesWrongShapes) {
  const PatchMesh mesh = furnace_seen_from({0.3, 0.4, 0.2}, {1, 1, 0.9});
  EXPECT_THROW(draw(mesh, Eigen::MatrixXd::Zero(2, 1), {}), UsageError);
  EXPECT_THROW(draw(mesh, Eigen::MatrixXd::Zero(mesh.patch_count(), 2), {}), UsageError);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Zero(mesh.patch_count(), 1);
  EXPECT_THROW(draw(mesh, B, {.width = 0}), UsageError);
  EXPECT_THROW(draw(mesh, B, {.height = 100000}), UsageError);
  EXPECT_THROW(draw(mesh, B, {.supersampling = 9}), UsageError);
}

TEST(VertexRadiosity, AveragesWithinAPlaneAndNotAroundCorners) {
  PatchMesh mesh = make_patches(box_room({1, 1, 1}), {.patches = 24});
  Eigen::MatrixXd B(mesh.patch_count(), 1);
  for (Index i = 0; i < mesh.patch_count(); ++i)  // linear on the floor, 100 elsewhere
    B(i, 0) = mesh.patches[static_cast<std::size_t>(i)].group == 2 ? mesh.centroid(0, i) : 100;
  const VertexRadiosity vertices(mesh, B);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Vector3 centroid = mesh.centroid.col(i);
    if (mesh.patches[static_cast<std::size_t>(i)].group != 2) {
      EXPECT_NEAR(vertices.at(i, centroid)[0], 100, 1e-12);  // no shade from the floor
      continue;
    }
    // 2 x 2 patches: 0.25 and 0.75; the corners in the middle of the room average to 0.5, those at the wall
    // do not.
    for (int k = 0; k < 4; ++k) {
      const double x = mesh.corner(i, k).x();
      EXPECT_NEAR(vertices.corner(i, k)[0], x < 0.25 ? 0.25 : x > 0.75 ? 0.75 : 0.5, 1e-12);
      EXPECT_NEAR(vertices.at(i, mesh.corner(i, k))[0], vertices.corner(i, k)[0], 1e-12);
    }
    EXPECT_NEAR(vertices.at(i, centroid)[0],
                0.25 * (vertices.corner(i, 0) + vertices.corner(i, 1) + vertices.corner(i, 2) +
                        vertices.corner(i, 3))[0],
                1e-12);
  }
}

TEST(VertexRadiosity, TakesWhatIsKnownAtCorners) {
  const PatchMesh mesh = make_patches(box_room({1, 1, 1}), {.patches = 24});
  Eigen::MatrixXd corners(4 * mesh.patch_count(), 1);
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < 4; ++k) corners(4 * i + k, 0) = mesh.corner(i, k).sum();
  const VertexRadiosity vertices(mesh, corners);
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(vertices.corner(i, k)[0], mesh.corner(i, k).sum(), 1e-12);
  EXPECT_THROW(VertexRadiosity(mesh, corners.topRows(7)), UsageError);
  // A picture interpolates from them only if it is asked to.
  const Eigen::MatrixXd B = Eigen::MatrixXd::Zero(mesh.patch_count(), 1);
  SilentMonitor monitor;
  const auto brightest = [&](bool interpolate) {
    const Picture picture =
        render_picture(mesh, B, {.width = 8, .height = 8, .interpolate = interpolate}, monitor, corners);
    return *std::max_element(picture.pixels.begin(), picture.pixels.end());
  };
  EXPECT_EQ(brightest(false), 0);
  EXPECT_GT(brightest(true), 0.1);
  EXPECT_THROW(render_picture(mesh, B, {}, monitor, corners.topRows(7)), UsageError);
}

TEST(VertexRadiosity, IsBarycentricOnTriangles) {
  const PatchMesh mesh = make_patches(sphere_room(0));
  const Eigen::MatrixXd B = Eigen::VectorXd::LinSpaced(mesh.patch_count(), 0, 1);
  const VertexRadiosity vertices(mesh, B);
  // Facets of a sphere lie in planes of their own: every corner keeps its patch's value.
  const Vector3 point = 0.2 * mesh.corner(7, 0) + 0.5 * mesh.corner(7, 1) + 0.3 * mesh.corner(7, 2);
  EXPECT_NEAR(vertices.at(7, point)[0], B(7, 0), 1e-12);
}

}  // namespace
}  // namespace radiosity
