// G5, G8, O3: what form factors must not depend on, and empty or lonely scenes.
#include "foundation/parallel.hpp"
#include "scene/built_in.hpp"
#include "tests/form_factors/hand_made_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

Scene moved(Scene scene, double scale, double offset) {
  for (Vector3& vertex : scene.vertices) vertex = vertex * scale + Vector3::Constant(offset);
  return scene;
}

FormFactors of(const Scene& scene, Index patches) {
  return compute(std::make_shared<const PatchMesh>(make_patches(scene, {.patches = patches})), raw());
}

TEST(Invariance, ScaleAndOffsetWithoutRays) {
  const Scene cube = built_in_scene("cube");
  const Eigen::MatrixXd unit = of(cube, 96).matrix();
  for (const double scale : {1e-6, 1e6})
    EXPECT_LE((of(moved(cube, scale, 0), 96).matrix() - unit).cwiseAbs().maxCoeff(), 1e-10);
  // The offset itself costs digits of the corners: 1e5 u = 1e-11 of the side.
  EXPECT_LE((of(moved(cube, 1, 1e5), 96).matrix() - unit).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Invariance, ScaleAndOffsetWithRays) {
  const Scene room = built_in_scene("cornell-box-closed");
  const Eigen::MatrixXd unit = of(room, 150).matrix();
  for (const double scale : {1e-6, 1e6})
    EXPECT_LE((of(moved(room, scale, 0), 150).matrix() - unit).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Invariance, ThreadsDoNotChangeABit) {
  const Scene room = built_in_scene("cornell-box-closed");
  std::vector<Eigen::MatrixXd> results;
  std::vector<std::uint64_t> rays;
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    const FormFactors form_factors = of(room, 300);
    results.push_back(form_factors.matrix());
    rays.push_back(form_factors.quality.rays);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
  EXPECT_EQ(rays[0], rays[2]);
}

TEST(Invariance, AnotherSeedIsAnotherSample) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 150}));
  FormFactorOptions other = raw();
  other.seed = 2;
  EXPECT_NE(compute(mesh, raw()).matrix(), compute(mesh, other).matrix());
}

TEST(Invariance, LonelyPatchesExchangeExactlyNothing) {
  HandMadeScene one;
  one.rectangle({0, 0, 0}, kX, kY);
  EXPECT_EQ(compute(one.mesh()).matrix(), Eigen::MatrixXd::Zero(1, 1));

  HandMadeScene plane;  // coplanar: nothing sees anything
  for (int k = 0; k < 3; ++k) plane.rectangle({2.0 * k, 0, 0}, kX, kY);
  EXPECT_EQ(compute(plane.mesh({.edge = 0.25})).matrix().maxCoeff(), 0);

  HandMadeScene back_to_back;
  back_to_back.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, -1}, kY, kX);
  EXPECT_EQ(compute(back_to_back.mesh()).matrix().maxCoeff(), 0);
}

TEST(Invariance, NoPatchesAtAll) {
  auto mesh = std::make_shared<PatchMesh>();
  mesh->scene = std::make_shared<const Scene>();
  mesh->reflectance.resize(0, 1), mesh->emission.resize(0, 1);
  const FormFactors form_factors = compute(mesh);
  EXPECT_EQ(form_factors.patch_count(), 0);
  EXPECT_EQ(form_factors.row_sums().size(), 0);
}

TEST(Invariance, ToleranceOutOfRangeIsRefused) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY);
  for (const double tolerance : {0.0, -1.0, 0.5, std::nan("")})
    EXPECT_THROW(compute(scene.mesh(), raw(tolerance)), UsageError);
}

TEST(Invariance, StoppingThrowsCancelled) {
  class Impatient final : public Monitor {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } monitor;
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 600}));
  EXPECT_THROW(compute_form_factors(mesh, {}, monitor), Cancelled);
}

// G4: slivers and duplicates stay finite, non-negative and reciprocal.
TEST(Invariance, SliversAndDuplicates) {
  for (const double aspect : {1e3, 1e6}) {
    const double thin = 1 / aspect;
    HandMadeScene scene;
    scene.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, 0}, kX, kY);  // twice the same
    scene.polygon({{0, 0, 1}, {0, thin, 1}, {1, 0, 1}})
        .polygon({{0, 0, 0.5}, {0, 1, 0.5}, {0, 1, 0.5 + thin}});
    scene.polygon({{0, 0, 0.2}, {0.5, thin, 0.2}, {1, 0, 0.2}});
    const auto mesh = scene.mesh();
    const Eigen::MatrixXd F = compute(mesh, raw()).matrix();
    EXPECT_TRUE(F.allFinite()) << aspect;
    EXPECT_GE(F.minCoeff(), 0) << aspect;
    const Eigen::MatrixXd exchange = mesh->area.asDiagonal() * F;
    EXPECT_LE((exchange - exchange.transpose()).cwiseAbs().maxCoeff(), 1e-5 * exchange.maxCoeff()) << aspect;
  }
}

}  // namespace
}  // namespace radiosity::testing
