#include "render/patch_rays.hpp"
#include "tests/gpu/frame_test.hpp"

#include <cmath>
#include <string>

namespace radiosity {
namespace {

/// E by rays from the very points that the device looks at; `shadows` = false: as if nothing were between.
Eigen::MatrixXd traced_emission(const PatchMesh& mesh, const EmissionPoints& points,
                                const std::vector<FrameLight>& lights, bool shadows = true) {
  const PatchRays rays(mesh);
  Eigen::MatrixXd received = Eigen::MatrixXd::Zero(mesh.patch_count(), 3);
  for (Index k = 0; k < points.position.cols(); ++k) {
    const Index patch = k / points.per_patch;
    const Vector3 point = points.position.col(k);
    for (const FrameLight& light : lights) {
      const Vector3 way = light.position - point;
      const Color arriving = unshadowed_irradiance(light, point, points.normal.col(k));
      if ((arriving == 0).all()) continue;
      const PatchHit hit = rays.from_patch(patch, point, way.normalized());
      if (!shadows || hit.missed() || (hit.point - point).norm() >= way.norm())
        received.row(patch) += arriving.matrix().transpose() / static_cast<double>(points.per_patch);
    }
  }
  return points.emission + points.reflectance.cwiseProduct(received);
}

/// Relative, over area and channels.
double mean_difference(const PatchMesh& mesh, const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (mesh.area.asDiagonal() * (found - expected).cwiseAbs()).sum() /
         (mesh.area.asDiagonal() * expected).sum();
}

using FrameEmission = FrameTest;

/// Points within a texel of a shadow's border may come out on its other side: with maps of 512 x 512 texels
/// that is less than 0.3 % of the light.
TEST_F(FrameEmission, ByShadowMapsIsThatOfTracedRaysFromTheSamePoints) {
  const auto mesh = box(150);
  const FrameScene scene = frame_scene(mesh, 6);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  const FrameOptions options{.width = 32, .height = 24, .shadow_size = 512, .products = 1};
  for (const FrameLightKind kind : {FrameLightKind::point, FrameLightKind::spot}) {
    FrameRenderer renderer(device(), scene, *transport, {kind}, options);
    for (const int k : {0, 2, 5}) {
      const std::vector<FrameLight> lights = light_at(*mesh, k, 7, kind);
      renderer.draw(lights, camera_of({}, *mesh));
      renderer.collect();
      const Eigen::MatrixXd found = renderer.emission();
      EXPECT_LT(mean_difference(*mesh, found, traced_emission(*mesh, scene.points, lights)), 0.003) << k;
      EXPECT_GT(mean_difference(*mesh, found, traced_emission(*mesh, scene.points, lights, false)), 0.03)
          << "would not notice missing shadows";
    }
  }
}

using FrameInjection = FrameTest;

/// In a room that is closed nothing of 1 W is lost: pixels of solid angle have all directions but for 1e-4.
TEST_F(FrameInjection, ByACubeKeepsThePowerAndIsNearThatOfPoints) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 150}));
  const FrameScene scene = frame_scene(mesh, 6);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  const FrameOptions options{.width = 32, .height = 24, .shadow_size = 512, .injection = Injection::cube};
  FrameRenderer renderer(device(), scene, *transport, {FrameLightKind::point}, options);
  for (const int k : {0, 2, 5}) {
    const std::vector<FrameLight> lights = light_at(*mesh, k, 7);
    renderer.draw(lights, camera_of({}, *mesh));
    renderer.collect();
    const Eigen::MatrixXd direct = renderer.emission() - mesh->emission;
    const Eigen::MatrixXd received = direct.cwiseQuotient(mesh->reflectance);
    EXPECT_NEAR(mesh->area.dot(received.col(0)), 1, 1e-3) << k;
    const Eigen::MatrixXd traced = traced_emission(*mesh, scene.points, lights) - mesh->emission;
    EXPECT_LT(mean_difference(*mesh, direct, traced), 0.03) << k;
  }
}

TEST_F(FrameInjection, OfASpotIsThatOfPointsToo) {
  const auto mesh = box(150);
  const FrameScene scene = frame_scene(mesh, 6);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  const FrameOptions options{.width = 32, .height = 24, .shadow_size = 64, .injection = Injection::cube};
  FrameRenderer renderer(device(), scene, *transport, {FrameLightKind::spot, FrameLightKind::point}, options);
  std::vector<FrameLight> lights = light_at(*mesh, 1, 7, FrameLightKind::spot);
  lights.push_back(light_at(*mesh, 5, 7).front());
  lights.back().intensity *= 0.1;
  renderer.draw(lights, camera_of({}, *mesh));
  EXPECT_LT(mean_difference(*mesh, renderer.emission(), traced_emission(*mesh, scene.points, lights)), 0.03);
}

using FrameLights = FrameTest;

/// Without shadows rounding is all that is left: light and lamps in an empty convex room, and of several
/// lights the sum.
TEST_F(FrameLights, AddUpAndComeOnTopOfWhatPatchesEmit) {
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 96}));
  const FrameScene scene = frame_scene(mesh, 3);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  FrameRenderer renderer(device(), scene, *transport, {FrameLightKind::spot, FrameLightKind::point},
                         {32, 24, 64, 1});
  std::vector<FrameLight> lights = light_at(*mesh, 1, 7, FrameLightKind::spot);
  lights.push_back(light_at(*mesh, 5, 7).front());
  lights.front().intensity = Color(1, 0.5, 0.25);
  renderer.draw(lights, camera_of({}, *mesh));
  const Eigen::MatrixXd expected = traced_emission(*mesh, scene.points, lights, false);
  EXPECT_GT(mesh->emission.maxCoeff(), 0);
  EXPECT_LT((renderer.emission() - expected).cwiseAbs().maxCoeff(), 1e-5 * expected.maxCoeff());
}

TEST_F(FrameLights, OtherThanAnnouncedOrWithoutADirectionAreRefused) {
  const auto mesh = box(150);
  const auto transport = on_device("dense:f32", form_factors_of(mesh));
  FrameRenderer renderer(device(), frame_scene(mesh, 2), *transport, {FrameLightKind::spot}, {8, 8, 16, 1});
  std::vector<FrameLight> lights = light_at(*mesh, 0, 3);
  EXPECT_THROW(renderer.draw(lights, camera_of({}, *mesh)), UsageError) << "a point";
  EXPECT_THROW(renderer.draw({}, camera_of({}, *mesh)), UsageError);
  lights = light_at(*mesh, 0, 3, FrameLightKind::spot);
  lights.front().target = lights.front().position;
  EXPECT_THROW(renderer.draw(lights, camera_of({}, *mesh)), UsageError) << "at its target";
}

}  // namespace
}  // namespace radiosity
