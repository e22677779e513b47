// G1, G3: form factors that are known in closed form.
#include "form_factors/contour_exchange.hpp"
#include "form_factors/quadrature_points.hpp"
#include "foundation/random.hpp"
#include "scene/built_in.hpp"
#include "tests/form_factors/hand_made_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace radiosity::testing {
namespace {

double factor(HandMadeScene& scene, double tolerance) {
  return compute(scene.mesh(), raw(tolerance))(0, 1);
}

double parallel_squares(double distance, double tolerance) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, distance}, kY, kX);
  return factor(scene, tolerance);
}

struct Wedge {
  double degrees;
  double tolerance;
};

double wedge_of_squares(const Wedge& wedge) {
  const double angle = wedge.degrees * std::numbers::pi / 180;
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, 0}, kY, Vector3(std::cos(angle), 0, std::sin(angle)));
  return factor(scene, wedge.tolerance);
}

// Slow and plain: Lambert's polygon formula at the points of a graded product rule.
double wedge_by_lambert(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vector3 d(std::cos(angle), 0, std::sin(angle));
  const std::array<Vector3, 4> other = {Vector3(0, 0, 0), Vector3(0, 1, 0), d + kY, d};
  const auto at_point = [&](const Vector3& p) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 a = (other[k] - p).normalized(), b = (other[(k + 1) % 4] - p).normalized();
      const Vector3 c = a.cross(b);
      if (c.norm() < 1e-300) continue;
      sum += std::atan2(c.norm(), a.dot(b)) * c.normalized().z();
    }
    return std::abs(sum) / (2 * std::numbers::pi);
  };
  // x = s^4 clusters points towards the common edge, y = 3 t^2 - 2 t^3 towards both ends of it.
  const int m = 400;
  double total = 0;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      const double s = (i + 0.5) / m, t = (j + 0.5) / m;
      const Vector3 p(std::pow(s, 4), t * t * (3 - 2 * t), 0);
      total += at_point(p) * 4 * std::pow(s, 3) * 6 * t * (1 - t) / (m * m);
    }
  }
  return total;
}

TEST(ClosedForm, ParallelUnitSquares) {
  EXPECT_NEAR(parallel_squares(1, 1e-4), 0.199824895698387, 1e-9);
  EXPECT_NEAR(parallel_squares(0.5, 1e-4), 0.415253283577, 1e-9);
  EXPECT_NEAR(parallel_squares(0.1, 1e-4), 0.826994522397, 1e-9);
  EXPECT_NEAR(parallel_squares(2, 1e-4), 0.068589588819, 1e-9);
}

TEST(ClosedForm, PerpendicularSquaresSharingAnEdge) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, 0}, kY, kZ);
  EXPECT_NEAR(factor(scene, 1e-4), 0.200043776075403, 1e-12);
}

TEST(ClosedForm, ToleranceIsKeptAtEveryDistance) {
  // Doubling the distance walks through the contour integral and all three orders of the product rule.
  for (const double distance : {1.0, 2.0, 3.0, 4.0, 6.0, 9.0, 14.0, 25.0, 60.0}) {
    const double reference = parallel_squares(distance, 1e-11);
    EXPECT_NEAR(parallel_squares(distance, 1e-4) / reference, 1, 1e-6) << distance;
    EXPECT_NEAR(parallel_squares(distance, 1e-7) / reference, 1, 1e-8) << distance;
  }
}

TEST(ClosedForm, WedgesOfUnitSquares) {
  EXPECT_NEAR(wedge_of_squares({30, 1e-4}), 0.619028323091, 1e-9);
  EXPECT_NEAR(wedge_of_squares({60, 1e-4}), 0.370905321150, 1e-9);
}

TEST(ClosedForm, WedgesFromOneTo179Degrees) {
  for (const double degrees : {1.0, 2.0, 5.0, 20.0, 45.0, 90.0, 120.0, 150.0, 170.0, 178.0, 179.0}) {
    const double value = wedge_of_squares({degrees, 1e-4});
    EXPECT_GE(value, 0) << degrees;
    EXPECT_LE(value, 1) << degrees;
    EXPECT_NEAR(value, wedge_by_lambert(degrees), 1e-3) << degrees;
    EXPECT_NEAR(value, wedge_of_squares({degrees, 1e-9}), 1e-6) << degrees;
  }
}

TEST(ClosedForm, UnitCubeRowsSumToOne) {
  for (const Index n : {6, 24, 54, 150, 864}) {
    const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = n}));
    ASSERT_EQ(mesh->patch_count(), n);
    const FormFactors form_factors = compute(mesh, raw(1e-12));
    const double deviation = (form_factors.row_sums().array() - 1).abs().maxCoeff();
    EXPECT_LE(deviation, std::max(static_cast<double>(n) * 1e-15, 8e-15)) << n;
  }
}

TEST(ClosedForm, ACubeAtDefaultToleranceAndItsBrokenVariant) {
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 864}));
  EXPECT_LE((compute(mesh, raw()).row_sums().array() - 1).abs().maxCoeff(), 1e-6);
  FormFactorOptions one_ray = raw();
  one_ray.method = FormFactorMethod::one_ray;
  EXPECT_GE((compute(mesh, one_ray).row_sums().array() - 1).abs().maxCoeff(), 1e-2);
}

// Product quadrature must not be used closer than least_ratio says: hold its fitted constants to random
// pairs.
TEST(ClosedForm, ProductQuadratureKeepsItsBound) {
  RandomStream random(7);
  const auto direction = [&] {
    Vector3 v;
    do v = Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    while (v.squaredNorm() > 1 || v.squaredNorm() < 0.01);
    return v.normalized();
  };
  int compared = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const bool triangles = trial % 2 == 1;
    const int order = static_cast<int>(random.below(3));
    constexpr double tolerance = 1e-6;
    const double ratio = QuadraturePoints::least_ratio(order, tolerance, triangles) * random.uniform(1, 1.3);
    std::vector<ConvexPolygon> polygons(2);
    std::vector<Plane> planes(2);
    int smaller_order = order;
    const Vector3 towards = direction();
    for (std::size_t side = 0; side < 2; ++side) {
      Vector3 normal = direction();
      if ((side == 0) != (normal.dot(towards) > 0)) normal = -normal;
      const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u),
                    center = side == 0 ? Vector3(0, 0, 0) : Vector3(ratio * towards);
      const int corners = triangles ? 3 : 4;
      const double turn = random.uniform(0, 6.3), size = side == 0 ? 1 : random.uniform(0.1, 1);
      if (side == 1)
        while (smaller_order > 0 &&
               ratio >= QuadraturePoints::least_ratio(smaller_order - 1, tolerance, triangles) * size)
          --smaller_order;
      for (int k = 0; k < corners; ++k) {
        const double angle = turn + 2 * std::numbers::pi * k / corners;
        polygons[side].add(center + size * (std::cos(angle) * u + std::sin(angle) * v));
      }
      planes[side].normal = normal;
      planes[side].offset = normal.dot(center);
    }
    bool facing = true;
    for (std::size_t side = 0; side < 2; ++side)
      for (const Vector3& corner : polygons[1 - side].corners()) facing &= planes[side].height(corner) >= 0;
    if (!facing) continue;
    const QuadraturePoints points(polygons, planes);
    double value = 0;
    points.exchange(order, order, 0, 1, 2, &value);
    const double bound = polygons[0].area_vector().norm() * polygons[1].area_vector().norm() /
                         (std::numbers::pi * ratio * ratio);
    const double exact = contour_exchange(polygons[0], polygons[1], 1e-12);
    EXPECT_NEAR(value, exact, tolerance * bound) << order << " " << ratio;
    points.exchange(order, smaller_order, 0, 1, 2, &value);
    EXPECT_NEAR(value, exact, 2 * tolerance * bound) << order << " " << smaller_order << " " << ratio;
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace radiosity::testing
