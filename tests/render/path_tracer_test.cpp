#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "render/patch_rays.hpp"
#include "render/path_sampling.hpp"
#include "render/path_tracer.hpp"
#include "rooms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace radiosity {
namespace {

using namespace test;

PathTracedIrradiance trace(const PatchMesh& mesh, const PathTracingOptions& options) {
  SilentMonitor monitor;
  return trace_paths(mesh, options, monitor);
}

/// How far estimates are from what they should be, in their own standard errors.
struct Verdict {
  double mean_square = 0;  ///< of the deviations: 1 for honest standard errors
  double beyond_four = 0;  ///< fraction of deviations above 4
  double mean = 0;         ///< of the deviations, times sqrt(count): a standard normal variable
};

Verdict judge(const Eigen::MatrixXd& estimate, const Eigen::MatrixXd& standard_error,
              const Eigen::MatrixXd& expected) {
  const Eigen::ArrayXXd deviations =
      (estimate - expected).array() / (standard_error.array() + 1e-12 * expected.array().abs());
  const auto count = static_cast<double>(deviations.size());
  return {deviations.square().mean(), static_cast<double>((deviations.abs() > 4).count()) / count,
          deviations.sum() / std::sqrt(count)};
}

bool accepted(const Verdict& verdict) {
  return verdict.beyond_four < 0.005 && verdict.mean_square < 1.5 && verdict.mean_square > 0.6 &&
         std::abs(verdict.mean) < 4;
}

class Furnace : public ::testing::TestWithParam<std::tuple<LightSampling, double>> {};

TEST_P(Furnace, ClosedRoomsHoldEmissionOverOneMinusReflectance) {
  const auto [lights, reflectance] = GetParam();
  for (const Scene& scene : {box_room({1, 1, 1}), box_room({3, 0.5, 2}), sphere_room(1)}) {
    PatchMesh mesh = make_patches(scene, {.patches = scene.faces.size() == 6 ? 96 : 0});
    make_furnace(mesh, reflectance, 2);
    const PathTracedIrradiance result = trace(mesh, {.paths = 2048, .lights = lights});
    const auto expected = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, 2 / (1 - reflectance));
    const Verdict verdict = judge(result.irradiance, result.standard_error, expected);
    EXPECT_TRUE(accepted(verdict)) << scene.name << ": " << verdict.mean_square << " " << verdict.beyond_four
                                   << " " << verdict.mean;
    EXPECT_EQ(result.leaks, 0U);
    EXPECT_EQ(result.back_hits, 0U);

    // Broken: emission counted twice, once where it is hit and once where it is sampled.
    const Eigen::MatrixXd twice = result.irradiance.array() + 2;
    EXPECT_FALSE(accepted(judge(twice, result.standard_error, expected)));
    // Broken: a standard error that claims four times the paths.
    EXPECT_FALSE(accepted(judge(result.irradiance, result.standard_error / 2, expected)));
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, Furnace,
                         ::testing::Combine(::testing::Values(LightSampling::on_hit, LightSampling::combined),
                                            ::testing::Values(0.3, 0.9)));

TEST(PathTracer, BlackFurnaceIsExactOnHit) {
  PatchMesh mesh = make_patches(box_room({1, 2, 3}));
  make_furnace(mesh, 0, 1.5);
  const PathTracedIrradiance result = trace(mesh, {.paths = 64, .lights = LightSampling::on_hit});
  EXPECT_NEAR(result.irradiance.minCoeff(), 1.5, 1e-12);
  EXPECT_NEAR(result.irradiance.maxCoeff(), 1.5, 1e-12);
}

/// Direct light in a black unit cube with one bright wall is the form factor of that wall: 0.199824896
/// opposite, 0.200043776 beside (hard case G1). Returns the deviations of the two in standard errors.
std::array<double, 2> wall_deviations(const PatchMesh& mesh, const Eigen::MatrixXd& H,
                                      const Eigen::MatrixXd& error) {
  const auto deviation = [&](int group, double expected) {
    double variance = 0;
    double area = 0;
    for (Index i = 0; i < mesh.patch_count(); ++i)
      if (mesh.patches[static_cast<std::size_t>(i)].group == group) {
        variance += std::pow(mesh.area[i] * error(i, 0), 2);
        area += mesh.area[i];
      }
    return (group_mean(mesh, group, H) - expected) / (std::sqrt(variance) / area);
  };
  return {deviation(3, 0.199824896), deviation(0, 0.200043776)};
}

PatchMesh bright_floor() {
  Scene scene = box_room({1, 1, 1});
  for (Material& material : scene.materials) material.reflectance.setZero();
  scene.materials[2].emission.setOnes();
  return make_patches(scene, {.patches = 96});
}

TEST(PathTracer, DirectLightOfAWallIsItsFormFactor) {
  const PatchMesh mesh = bright_floor();
  for (const LightSampling lights : {LightSampling::on_hit, LightSampling::combined}) {
    const PathTracedIrradiance result = trace(mesh, {.paths = 8192, .lights = lights});
    for (const double deviation : wall_deviations(mesh, result.irradiance, result.standard_error))
      EXPECT_LT(std::abs(deviation), 4);
  }
}

TEST(PathTracer, DirectLightCheckCatchesWrongCosine) {
  // A tracer of its own for direct light, once with the right directions and once with uniform ones.
  const PatchMesh mesh = bright_floor();
  const PatchRays rays(mesh);
  using Sampler = std::function<Vector3(const Vector3&, double, double)>;
  const auto deviations = [&](const Sampler& sample) {
    constexpr int paths = 8192;
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(mesh.patch_count(), 1);
    for (Index i = 0; i < mesh.patch_count(); ++i) {
      RandomStream random(7, static_cast<std::uint64_t>(i));
      for (int k = 0; k < paths; ++k) {
        const double s = random.uniform();
        const double t = random.uniform();
        const double u = random.uniform();
        const double v = random.uniform();
        const PatchHit hit =
            rays.from_patch(i, point_on_patch(mesh, i, s, t), sample(mesh.normal.col(i), u, v));
        if (!hit.missed() && hit.front) mean(i, 0) += mesh.emission(hit.patch, 0) / paths;
      }
    }
    const Eigen::MatrixXd error = (mean.array() * (1 - mean.array()) / paths).sqrt();
    return wall_deviations(mesh, mean, error);
  };
  for (const double deviation : deviations(cosine_direction)) EXPECT_LT(std::abs(deviation), 4);
  const auto uniform = [](const Vector3& normal, double u, double v) -> Vector3 {
    const Vector3 tangent = normal.unitOrthogonal();
    const double radius = std::sqrt(1 - u * u);
    const double angle = 2 * std::numbers::pi * v;
    return radius * std::cos(angle) * tangent + radius * std::sin(angle) * normal.cross(tangent) + u * normal;
  };
  for (const double deviation : deviations(uniform)) EXPECT_GT(std::abs(deviation), 10);
}

TEST(PathTracer, ClosedRoomAbsorbsWhatItEmits) {
  // sum A (1 - rho) H = sum A E holds in any closed room, whatever the distribution of light.
  Scene scene = box_room({2, 1, 1.5});
  for (std::size_t k = 0; k < 6; ++k)
    scene.materials[k].reflectance =
        Color(0.1 * static_cast<double>(k + 1), 0.5, 0.9 - 0.1 * static_cast<double>(k));
  scene.materials[3].emission = Color(5, 3, 1);
  scene.materials[0].emission = Color(0, 0.5, 2);
  const PatchMesh mesh = make_patches(scene, {.patches = 54});
  for (const LightSampling lights : {LightSampling::on_hit, LightSampling::combined}) {
    const PathTracedIrradiance result = trace(mesh, {.paths = 4096, .lights = lights});
    for (Index c = 0; c < 3; ++c) {
      const Eigen::VectorXd weight = mesh.area.array() * (1 - mesh.reflectance.col(c).array());
      const double absorbed = weight.dot(result.irradiance.col(c));
      const double error = weight.cwiseProduct(result.standard_error.col(c)).norm();
      EXPECT_LT(std::abs(absorbed - mesh.area.dot(mesh.emission.col(c))), 4 * error);
      EXPECT_LT(error, 0.02 * absorbed);
    }
  }
}

TEST(PathTracer, StandardErrorsAreThoseOfRepeatedRuns) {
  const PatchMesh mesh = make_patches([] {
    Scene scene = box_room({1, 1, 1});
    scene.materials[3].emission.setOnes();
    return scene;
  }());
  constexpr int runs = 200;
  for (const LightSampling lights : {LightSampling::on_hit, LightSampling::combined}) {
    Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(6);
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(6);
    Eigen::ArrayXd claimed = Eigen::ArrayXd::Zero(6);
    for (int run = 0; run < runs; ++run) {
      const auto result =
          trace(mesh, {.paths = 512, .lights = lights, .seed = static_cast<std::uint64_t>(run)});
      const Eigen::ArrayXd H = result.irradiance.col(0).array();
      mean += H / runs;
      squares += H.square() / runs;
      claimed += result.standard_error.col(0).array().square() / runs;
    }
    // The ratio of variances has a relative standard error of sqrt(2 / runs) = 0.1 for each patch.
    const Eigen::ArrayXd ratio = (squares - mean.square()) / claimed;
    EXPECT_LT((ratio - 1).abs().maxCoeff(), 0.4) << ratio.transpose();
    EXPECT_NEAR(ratio.mean(), 1, 0.17);
  }
}

TEST(PathTracer, BothWaysToFindLightAgree) {
  Scene scene = box_room({2, 1, 1});
  scene.materials[1].emission.setOnes();
  add_square(scene, 0.5, true, 0, 0.7);  // a plate in the room: fronts and backs
  const PatchMesh mesh = make_patches(scene, {.patches = 60});
  const auto hit = trace(mesh, {.paths = 8192, .lights = LightSampling::on_hit, .seed = 1});
  const auto combined = trace(mesh, {.paths = 8192, .lights = LightSampling::combined, .seed = 2});
  const Eigen::MatrixXd error =
      (hit.standard_error.cwiseAbs2() + combined.standard_error.cwiseAbs2()).cwiseSqrt();
  const Verdict verdict = judge(hit.irradiance, error, combined.irradiance);
  EXPECT_LT(verdict.beyond_four, 0.01);
  EXPECT_LT(verdict.mean_square, 1.5);
  EXPECT_GT(hit.back_hits, 0U);
  EXPECT_LT(combined.standard_error.squaredNorm(), hit.standard_error.squaredNorm());
}

TEST(PathTracer, BacksAbsorbAndOpenScenesLose) {
  Scene facing;
  add_square(facing, 0, true, 0, 0.5);
  add_square(facing, 1, false, 1, 0);
  const PatchMesh open = make_patches(facing);
  const auto lit = trace(open, {.paths = 65536});
  EXPECT_NEAR(lit.irradiance(0, 0), 0.199824896, 4 * lit.standard_error(0, 0));
  EXPECT_GT(lit.irradiance(1, 0), 0);  // its own light, sent back by the other square
  EXPECT_GT(lit.misses, 0U);
  EXPECT_EQ(lit.leaks, 0U);  // there is a way out

  Scene averted;
  add_square(averted, 0, true, 0, 0.5);
  add_square(averted, 1, true, 1, 0);
  const auto dark = trace(make_patches(averted), {.paths = 1024});
  EXPECT_EQ(dark.irradiance(0, 0), 0);
  EXPECT_GT(dark.back_hits, 0U);
}

TEST(PathTracer, TwoSidedPlatesShowTheirFrontOnBothSides) {
  Scene scene;
  add_square(scene, 0, true, 0, 0);
  add_square(scene, 2, false, 0, 0);
  add_square(scene, 1, true, 1, 0);
  const PatchMesh mesh = make_patches(two_sided(scene));
  const auto result = trace(mesh, {.paths = 65536});
  int lit = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    if (result.irradiance(i, 0) > 0) {
      EXPECT_NEAR(result.irradiance(i, 0), 0.199824896, 4 * result.standard_error(i, 0));
      ++lit;
    }
  EXPECT_EQ(lit, 2);
}

TEST(PathTracer, SizeAndPlaceDoNotMatter) {
  Scene scene = box_room({1, 1, 1});
  scene.materials[3].emission.setOnes();
  const auto unit = trace(make_patches(scene, {.patches = 24}), {.paths = 1024});
  for (const auto& [scale, offset] : {std::pair{1e-6, 0.0}, {1e6, 0.0}, {1.0, 1e5}}) {
    Scene moved = scene;
    for (Vector3& vertex : moved.vertices) vertex = scale * vertex + Vector3::Constant(offset);
    const auto result = trace(make_patches(moved, {.patches = 24}), {.paths = 1024});
    EXPECT_EQ(result.leaks, 0U);
    EXPECT_LT((result.irradiance - unit.irradiance).cwiseAbs().maxCoeff(),
              0.5 * unit.standard_error.maxCoeff())
        << "scale " << scale << ", offset " << offset;
  }
}

TEST(PathTracer, ThreadsDoNotMatterAndSeedsDo) {
  Scene scene = box_room({1, 1, 1});
  scene.materials[3].emission = Color(1, 2, 3);
  const PatchMesh mesh = make_patches(scene, {.patches = 54});
  const auto run = [&](int threads, std::uint64_t seed) {
    const ThreadLimit limit(threads);
    return trace(mesh, {.paths = 256, .seed = seed});
  };
  const auto first = run(1, 1);
  for (const int threads : {2, 8}) {
    const auto other = run(threads, 1);
    EXPECT_EQ(first.irradiance, other.irradiance);
    EXPECT_EQ(first.standard_error, other.standard_error);
    EXPECT_EQ(first.rays, other.rays);
  }
  EXPECT_NE(first.irradiance, run(1, 2).irradiance);
}

TEST(PathTracer, StopsAtTheWantedStandardError) {
  Scene scene = box_room({1, 1, 1});
  scene.materials[3].emission.setOnes();
  const PatchMesh mesh = make_patches(scene);
  const auto result = trace(mesh, {.paths = 64, .standard_error = 0.01});
  EXPECT_LE(result.relative_standard_error(mesh.area), 0.01);
  EXPECT_GT(result.paths, 64U);
  EXPECT_EQ(result.paths % 64, 0U);
}

TEST(PathTracer, RefusesWhatItCannotFollow) {
  PatchMesh mesh = make_patches(box_room({1, 1, 1}));
  EXPECT_THROW(trace(mesh, {.paths = 0}), UsageError);
  EXPECT_THROW(trace(mesh, {.standard_error = -1}), UsageError);
  mesh.reflectance(4, 0) = 1;
  try {
    trace(mesh, {});
    FAIL() << "reflectance 1 went through";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("patch 4"), std::string::npos) << error.what();
  }
}

TEST(PathTracer, StopsOnRequest) {
  class Impatient final : public Monitor {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } monitor;
  PatchMesh mesh = make_patches(box_room({1, 1, 1}));
  EXPECT_THROW(trace_paths(mesh, {}, monitor), Cancelled);
}

}  // namespace
}  // namespace radiosity
