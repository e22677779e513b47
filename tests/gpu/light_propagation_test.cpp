#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "frame/instant_radiosity.hpp"
#include "frame/light_propagation.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace radiosity {
namespace {

Eigen::AlignedBox3d box(double size) {
  return {Vector3::Zero(), Vector3::Constant(size)};
}

TEST(LightVolume, HasItsCellsAlongTheLongestEdgeAndOneMoreOnEverySide) {
  const LightVolume volume({Vector3(1, 2, 3), Vector3(1 + 8, 2 + 4, 3 + 0.5)}, 16);
  EXPECT_EQ(volume.cell(), 0.5);
  EXPECT_EQ(volume.cells(), (std::array<int, 3>{18, 10, 3}));
}

TEST(LightVolume, KeepsFluxWhereNothingStopsIt) {
  LightVolume volume(box(16), 16);
  volume.add_light({8.2, 7.9, 8.1}, Vector3(1, 2, -1).normalized(), {3, 2, 0});
  for (int step = 0; step < 8; ++step) {
    EXPECT_NEAR(volume.flux()[0], 3, 1e-9) << step;
    EXPECT_NEAR(volume.flux()[1], 2, 1e-9) << step;
    EXPECT_EQ(volume.flux()[2], 0);
    volume.propagate(1);
  }
  volume.darken();
  EXPECT_EQ(volume.flux()[0], 0);
  EXPECT_TRUE((volume.irradiance({8, 8, 8}, Vector3::UnitX()) == 0).all());
}

TEST(LightVolume, LosesWhatLeavesItsGrid) {
  LightVolume volume(box(3), 3);
  volume.add_light({1.5, 1, 1.5}, Vector3::UnitY(), Color::Ones());
  volume.propagate(60);
  EXPECT_LT(volume.flux()[0], 0.01);
}

TEST(LightVolume, SendsLightToWhereItsSurfaceLooks) {
  LightVolume volume(box(16), 16);
  volume.add_light({8.5, 8, 8.5}, Vector3::UnitY(), Color::Ones());
  volume.propagate(24);
  const double above = volume.irradiance({8.5, 12, 8.5}, -Vector3::UnitY())[0];
  EXPECT_GT(above, 2.5 * volume.irradiance({8.5, 12, 8.5}, Vector3::UnitY())[0]);
  EXPECT_GT(above, 2.5 * volume.irradiance({8.5, 5, 8.5}, Vector3::UnitY())[0]);  // from above
  // As a point that radiates 1 / pi W/sr does, but for how a few cells and harmonics smear it.
  EXPECT_NEAR(above * std::numbers::pi * 16, 1, 0.3);
  // The same to the left as to the right.
  EXPECT_NEAR(volume.irradiance({5, 11, 8.5}, Vector3::UnitX())[0],
              volume.irradiance({12, 11, 8.5}, -Vector3::UnitX())[0], 1e-6);
}

TEST(LightVolume, IsStoppedByTheFrontsOfSurfaces) {
  const auto behind = [](double cover, double towards_light) {
    LightVolume volume(box(8), 8);
    for (int i = 0; i < 20; ++i)
      for (int k = 0; k < 20; ++k)
        volume.add_surface({0.5 * i - 0.75, 4, 0.5 * k - 0.75}, {0, -towards_light, 0}, cover * 0.25);
    volume.add_light({4.5, 1, 4.5}, Vector3::UnitY(), Color::Ones());
    volume.propagate(16);
    return volume.irradiance({4.5, 7, 4.5}, -Vector3::UnitY())[0];
  };
  const double open = behind(0, 1);
  EXPECT_LT(behind(1, 1), 0.3 * open);  // two orders of harmonics make 3/4 of a surface that covers all
  EXPECT_GT(behind(1, -1), 0.5 * open);
  EXPECT_LT(behind(0.5, 1), open);
}

TEST(LightVolume, RefusesGridsThatCannotBe) {
  EXPECT_THROW(LightVolume(box(1), 1), UsageError);
  EXPECT_THROW(LightVolume(box(1), 257), UsageError);
  EXPECT_THROW(LightVolume(box(0), 16), UsageError);
  EXPECT_THROW(LightVolume(Eigen::AlignedBox3d(), 16), UsageError);
}

class PropagatedLight : public testing::Test {
 protected:
  PropagatedLight()
      : mesh_(make_patches(built_in_scene("cornell-box"), {.patches = 200})), rays_(dark(mesh_)) {}

  static const PatchMesh& dark(PatchMesh& mesh) {
    mesh.emission.setZero();
    return mesh;
  }

  Picture frame(const LightPropagationOptions& options) {
    return LightPropagation(mesh_, rays_, options).draw(lights_, *mesh_.scene->camera, monitor_);
  }

  PatchMesh mesh_;
  PatchRays rays_;
  std::vector<FrameLight> lights_ = {
      {FrameLightKind::point, {0.28, 0.4, 0.15}, Vector3::Zero(), Color::Constant(1), 45}};
  SilentMonitor monitor_;
};

TEST_F(PropagatedLight, AddsIndirectLightToDirectLight) {
  const Picture direct = frame({.width = 24, .height = 18, .cells = 12, .steps = 0});
  const Picture whole = frame({.width = 24, .height = 18, .cells = 12, .steps = 24});
  double direct_sum = 0;
  double sum = 0;
  for (std::size_t k = 0; k < whole.pixels.size(); ++k) {
    EXPECT_GE(whole.pixels[k], direct.pixels[k]);
    direct_sum += static_cast<double>(direct.pixels[k]);
    sum += static_cast<double>(whole.pixels[k]);
  }
  EXPECT_GT(sum, 1.1 * direct_sum);
  EXPECT_LT(sum, 3 * direct_sum);
}

double sum_of(const Picture& picture) {
  return std::accumulate(picture.pixels.begin(), picture.pixels.end(), 0.0);
}

TEST_F(PropagatedLight, IsAboutThatOfTheFirstReflection) {
  constexpr int width = 24;
  constexpr int height = 18;
  const double direct = sum_of(frame({.width = width, .height = height, .cells = 12, .steps = 0}));
  const double propagated = sum_of(frame({.width = width, .height = height, .cells = 12, .steps = 24}));
  const InstantRadiosityOptions first_reflection{
      .width = width, .height = height, .paths = 1024, .closest = 0.1, .reflections = 1};
  const double first = sum_of(
      instant_radiosity(mesh_, rays_, lights_, *mesh_.scene->camera, first_reflection, monitor_).picture);
  EXPECT_NEAR((propagated - direct) / (first - direct), 1, 0.15);
}

TEST_F(PropagatedLight, DoesNotDependOnThreads) {
  const LightPropagationOptions options{.width = 16, .height = 12, .cells = 10, .steps = 12, .seed = 3};
  const ThreadLimit one(1);
  const Picture first = frame(options);
  const ThreadLimit four(4);
  EXPECT_EQ(first.pixels, frame(options).pixels);
}

TEST_F(PropagatedLight, RefusesWhatItDoesNotFollow) {
  EXPECT_THROW(frame({.width = 4, .height = 4, .steps = -1}), UsageError);
  mesh_.emission.setOnes();
  EXPECT_THROW(frame({.width = 4, .height = 4}), UsageError);
}

}  // namespace
}  // namespace radiosity
