#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "frame/instant_radiosity.hpp"
#include "frame/picture_difference.hpp"
#include "frame/traced_frame.hpp"
#include "frame/virtual_lights.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace radiosity {
namespace {

PatchMesh dark(const char* scene) {
  PatchMesh mesh = make_patches(built_in_scene(scene));
  mesh.emission.setZero();
  return mesh;
}

Color flux_of(const std::vector<VirtualLight>& lights) {
  Color sum = Color::Zero();
  for (const VirtualLight& light : lights) sum += light.flux;
  return sum;
}

FrameLight lamp(const Vector3& position) {
  return {FrameLightKind::point, position, Vector3::Zero(), Color::Constant(intensity_of_a_watt), 45};
}

// Half of a watt is reflected first, half of that next, ...: one watt in all.
TEST(VirtualLights, CarryTheLightOfAllReflections) {
  const PatchMesh cube = dark("cube");
  const PatchRays rays(cube);
  const auto lights = virtual_lights(cube, rays, {lamp({0.3, 0.6, 0.4})}, 4096, 1);
  EXPECT_NEAR(flux_of(lights)[0], 1, 0.03);
  EXPECT_NEAR(static_cast<double>(lights.size()) / 4096, 2, 0.06);
  for (const VirtualLight& light : lights) EXPECT_GT((light.flux > 0).count(), 0);
}

TEST(VirtualLights, OfASpotHaveTheFluxOfItsCone) {
  const PatchMesh cube = dark("cube");
  const PatchRays rays(cube);
  const FrameLight spot{FrameLightKind::spot, {0.5, 0.9, 0.5}, {0.3, 0, 0.4}, {2, 1, 0}, 50};
  const SpotCone cone(spot.half_angle);
  double flux = 0;  // into the cone, of 1 W/sr on the axis
  constexpr int steps = 1000;
  for (int k = 0; k < steps; ++k)
    flux += 2 * std::numbers::pi * (1 - cone.end) / steps * cone.part(1 - (k + 0.5) / steps * (1 - cone.end));
  const Color found = flux_of(virtual_lights(cube, rays, {spot}, 4096, 2));
  EXPECT_NEAR(found[0] / (2 * flux), 1, 0.03);
  EXPECT_NEAR(found[1] / flux, 1, 0.03);
  EXPECT_EQ(found[2], 0);
}

TEST(VirtualLights, DoNotPassThroughBacks) {
  const PatchMesh cube = dark("cube");
  const PatchRays rays(cube);
  EXPECT_TRUE(virtual_lights(cube, rays, {lamp({0.5, 3, 0.5})}, 256, 1).empty());
}

class InstantRadiosity : public testing::Test {
 protected:
  static constexpr int width = 24;
  static constexpr int height = 18;

  InstantRadiosityFrame frame(int paths, double closest, std::uint64_t seed = 1) {
    return instant_radiosity(mesh_, PatchRays(mesh_), lights_, *mesh_.scene->camera,
                             {width, height, paths, closest, seed}, monitor_);
  }

  PatchMesh mesh_ = dark("cornell-box");
  std::vector<FrameLight> lights_ = {lamp({0.28, 0.4, 0.15})};
  SilentMonitor monitor_;
};

/// Path tracing from the other end shares the direct light with it, and no more.
TEST_F(InstantRadiosity, IsPathTracingUnlessItClamps) {
  const TracedFrame traced =
      trace_frame(mesh_, lights_, *mesh_.scene->camera, {width, height, 256, 1}, monitor_);
  const InstantRadiosityFrame plain = frame(1024, 0.01);
  EXPECT_GT(plain.virtual_lights, 1024U);
  const PictureDifference difference = difference_of(plain.picture, traced);
  const PictureDifference clamped = difference_of(frame(1024, 0.3).picture, traced);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(std::fabs(difference.mean[c]), 0.015) << c;
    EXPECT_LT(clamped.mean[c], -0.03) << c << ": what clamping loses";
  }
}

TEST_F(InstantRadiosity, DependsOnTheSeedButNotOnThreads) {
  const Picture picture = frame(16, 0.1).picture;
  EXPECT_NE(picture.pixels, frame(16, 0.1, 2).picture.pixels);
  const ThreadLimit limit(1);
  EXPECT_EQ(picture.pixels, frame(16, 0.1).picture.pixels);
}

TEST_F(InstantRadiosity, RefusesWhatItCannotFollow) {
  EXPECT_THROW(frame(0, 0.1), UsageError);
  EXPECT_THROW(frame(1, -1), UsageError);
  mesh_.emission(0, 0) = 1;
  EXPECT_THROW(frame(1, 0.1), UsageError);
  mesh_.emission.setZero();
  mesh_.reflectance(0, 0) = 1;
  EXPECT_THROW(frame(1, 0.1), UsageError);
}

}  // namespace
}  // namespace radiosity
