// Blocked pairs: exact overlaps, proofs, doors, and what a wrong occlusion test would do.
#include "form_factors/pair_exchange.hpp"
#include "form_factors/shaft.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "scene/built_in.hpp"
#include "tests/form_factors/hand_made_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

struct Screen {
  const char* what;
  Vector3 corner, u, v;
  double exact;
};

// Values of the separable overlap integral, checked by independent quadrature to 2e-9.
const Screen kScreens[] = {
    {"a quarter", {0, 0, 0.5}, 0.5 * kX, 0.5 * kY, 0.1498686718},
    {"the centre", {0.25, 0.25, 0.5}, 0.5 * kX, 0.5 * kY, 0.0995062946},
    {"half a plane", {-5, -5, 0.5}, 5.5 * kX, 11 * kY, 0.0999124478},
};

std::shared_ptr<const PatchMesh> screened_squares(const Screen& screen, double edge = 0) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY)
      .rectangle({0, 0, 1}, kY, kX)
      .rectangle(screen.corner, screen.u, screen.v);
  return scene.mesh({.edge = edge});
}

TEST(Visibility, ScreensBetweenTwoSquaresAtAnySeed) {
  for (const Screen& screen : kScreens) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      FormFactorOptions options = raw();
      options.seed = seed;
      const FormFactors form_factors = compute(screened_squares(screen), options);
      EXPECT_NEAR(form_factors(0, 1) / screen.exact, 1, 2e-3) << screen.what << " seed " << seed;
      const double error = form_factors.group_standard_error(0, 1);
      EXPECT_LE(error, 1e-4) << screen.what;
      EXPECT_LE(std::abs(form_factors(0, 1) - screen.exact), 5 * error) << screen.what << " seed " << seed;
    }
  }
}

TEST(Visibility, GroupsOfManyPatchesMeetTheSameTolerance) {
  for (const Screen& screen : kScreens) {
    const auto mesh = screened_squares(screen, 0.13);
    const FormFactors form_factors = compute(mesh, raw());
    double exchange = 0, area = 0;
    for (Index i = 0; i < mesh->patch_count(); ++i) {
      if (mesh->patches[static_cast<std::size_t>(i)].group != 0) continue;
      area += mesh->area[i];
      for (Index j = 0; j < mesh->patch_count(); ++j)
        if (mesh->patches[static_cast<std::size_t>(j)].group == 1)
          exchange += mesh->area[i] * form_factors(i, j);
    }
    EXPECT_NEAR(exchange / area, screen.exact, 5e-4 * screen.exact) << screen.what;
    EXPECT_LE(form_factors.group_standard_error(0, 1), 1e-4) << screen.what;
  }
}

TEST(Visibility, AWholeScreenLeavesExactlyNothing) {
  const FormFactors form_factors = compute(screened_squares({"all", {0, 0, 0.5}, kX, kY, 0}), raw());
  EXPECT_EQ(form_factors(0, 1), 0);
  EXPECT_EQ(form_factors(1, 0), 0);
}

TEST(Visibility, RoomsWithoutADoorExchangeExactlyNothing) {
  HandMadeScene scene;
  scene.box({0, 0, 0}, kX, kY, kZ, true).box({1.5, 0, 0}, kX, kY, kZ, true);
  const auto mesh = scene.mesh({.edge = 0.3});
  const FormFactors form_factors = compute(mesh, raw());
  const Index half = mesh->patch_count() / 2;
  EXPECT_EQ(form_factors.matrix().topRightCorner(half, half).maxCoeff(), 0);
  EXPECT_LE((form_factors.row_sums().array() - 1).abs().maxCoeff(), 1e-6);
}

TEST(Visibility, BlocksInARoomKeepRowSumsAndReciprocity) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 800}));
  const FormFactors form_factors = compute(mesh, raw());
  EXPECT_LE(form_factors.quality.row_sum_rms, 2e-3);
  EXPECT_EQ(form_factors.quality.reciprocity_max, 0);
  EXPECT_EQ(form_factors.quality.back_hits, 0U);
  const Eigen::MatrixXd F = form_factors.matrix();
  EXPECT_GE(F.minCoeff(), 0);
  const Eigen::MatrixXd exchange = mesh->area.asDiagonal() * F;
  EXPECT_LE((exchange - exchange.transpose()).cwiseAbs().maxCoeff(), 1e-12 * exchange.maxCoeff());
}

FormFactors form_factors_of_patio(const Scene& scene) {
  return compute(std::make_shared<const PatchMesh>(make_patches(scene, {.patches = 600})), raw(1e-3));
}

/// Patches of a storey with their centres between two planes normal to z.
std::vector<Index> part_of_patio(const PatchMesh& mesh, const std::string& storey, double low, double high) {
  std::vector<Index> found;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const auto group = static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group);
    const double z = mesh.centroid(2, i);
    if (room_of_group(mesh.scene->groups[group]) == storey && z > low && z < high) found.push_back(i);
  }
  return found;
}

TEST(Visibility, StoreysOfAPatioSeeEachOtherAcrossTheCourtOnly) {
  const FormFactors form_factors = form_factors_of_patio(built_in_scene("patio:sky=closed"));
  EXPECT_EQ(form_factors.quality.leaks, 0U);
  EXPECT_EQ(form_factors.quality.reciprocity_max, 0);
  EXPECT_LE(form_factors.quality.row_sum_rms, 1e-2);
  const std::vector<Index> upper = part_of_patio(*form_factors.mesh, "upper", 0, 2.5);
  const Eigen::MatrixXd F = form_factors.matrix();
  EXPECT_EQ(F(upper, part_of_patio(*form_factors.mesh, "ground", 0, 2.5)).maxCoeff(), 0);
  EXPECT_GT(F(upper, part_of_patio(*form_factors.mesh, "ground", 13, 15.5)).sum(), 0.01);
}

// The check above can fail: without the slab, light goes from storey to storey within a gallery.
TEST(Visibility, StoreysOfAPatioWithoutASlabSeeEachOther) {
  Scene scene = built_in_scene("patio:sky=closed");
  std::erase_if(scene.faces, [&](const Face& face) {
    const std::string& group = scene.groups[static_cast<std::size_t>(face.group)];
    return group == "upper/floor" || group == "ground/ceiling" || group.starts_with("lamp");
  });
  const FormFactors form_factors = form_factors_of_patio(scene);
  const std::vector<Index> upper = part_of_patio(*form_factors.mesh, "upper", 0, 2.5);
  EXPECT_GT(form_factors.matrix()(upper, part_of_patio(*form_factors.mesh, "ground", 0, 2.5)).sum(), 0.1);
}

// R3: float32 rays among faces of 1e-6 to 1e6 m^2. Rays that stood off every face alike, or started at the
// larger of two patches, missed up to a third of the light of the smallest ones.
TEST(Visibility, FacesOfVeryUnequalSizeSeeEachOther) {
  for (const Index patches : {0, 100, 600}) {
    const auto mesh =
        std::make_shared<const PatchMesh>(make_patches(built_in_scene("uneven-areas"), {.patches = patches}));
    const FormFactors form_factors = compute(mesh, raw());
    EXPECT_LE((form_factors.row_sums().array() - 1).abs().maxCoeff(), 1e-2) << patches;
    EXPECT_LE(form_factors.quality.row_sum_rms, 2e-3) << patches;
  }
}

// The row sums of a closed room do see a tracer that forgets the blocks.
TEST(Visibility, ForgettingTheBlocksBreaksTheRowSums) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 800}));
  const PatchGeometry geometry(*mesh);
  const UnobstructedExchange unobstructed(geometry, 1e-6);
  double worst = 0;
  double exchange[PairHeights::capacity];
  for (int i = 0; i < geometry.patch_count(); ++i) {
    double sum = 0;
    for (const PatchCluster& cluster : geometry.clusters()) {
      unobstructed.with_cluster(i, cluster, exchange);
      for (int l = 0; l < cluster.end - cluster.begin; ++l) sum += exchange[l] / geometry.area(i);
    }
    worst = std::max(worst, std::abs(sum - 1));
  }
  EXPECT_GT(worst, 0.1);
}

// Proofs against the plain truth: segments between random points of random triangles.
TEST(Visibility, ProofsAboutShaftsAreNeverWrong) {
  RandomStream random(3);
  const auto triangle = [&](const Vector3& center, double size) {
    ConvexPolygon polygon;
    for (int k = 0; k < 3; ++k)
      polygon.add(center +
                  size * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    return polygon;
  };
  const auto point = [&](const ConvexPolygon& t) -> Vector3 {
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
  };
  const auto cuts = [](const Blocker& blocker, const Vector3& p, const Vector3& q) {
    const double hp = blocker.plane.height(p), hq = blocker.plane.height(q);
    if (hp * hq >= 0) return false;
    const Vector3 x = p + (q - p) * (hp / (hp - hq));
    for (int k = 0; k < 3; ++k)
      if ((blocker.polygon.next(k) - blocker.polygon[k])
              .cross(x - blocker.polygon[k])
              .dot(blocker.plane.normal) < 0)
        return false;
    return true;
  };
  int missed = 0, blocked = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const ConvexPolygon a = triangle({0, 0, 0}, 0.4), b = triangle({0, 0, 3}, 0.4);
    const Blocker blocker(
        triangle({random.uniform(-1, 1), random.uniform(-1, 1), 1.5}, random.uniform(0.2, 4)));
    const bool misses = misses_shaft(blocker, a.corners(), b.corners());
    const bool blocks = blocks_shaft(blocker, a.corners(), b.corners());
    EXPECT_FALSE(misses && blocks);
    missed += misses, blocked += blocks;
    for (int k = 0; k < 50; ++k) {
      const bool cut = cuts(blocker, point(a), point(b));
      EXPECT_FALSE(misses && cut);
      EXPECT_FALSE(blocks && !cut);
    }
  }
  EXPECT_GT(missed, 300);
  EXPECT_GT(blocked, 30);
}

TEST(Visibility, TheRayTracerLeavesTheNumberOfThreadsAlone) {
  const int before = ThreadLimit::current();
  HandMadeScene scene;
  scene.box({0, 0, 0}, kX, kY, kZ, true);
  const auto mesh = scene.mesh();
  const PairExchange exchange(*mesh, 1e-4, 1);
  EXPECT_EQ(ThreadLimit::current(), before);
}

}  // namespace
}  // namespace radiosity::testing
