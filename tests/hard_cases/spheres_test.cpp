// E2 on traced scenes: a faceted sphere and a faceted bowl come nearer to the closed forms with finer facets.

#include "operators/operator_registry.hpp"
#include "scene/import.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace radiosity {
namespace {

struct Traced {
  std::shared_ptr<const PatchMesh> mesh;
  FormFactors form_factors;
  Field radiosity;
};

Traced solved(const std::string& scene) {
  Traced traced;
  traced.mesh = std::make_shared<const PatchMesh>(make_patches(open_scene(scene)));
  SilentMonitor monitor;
  traced.form_factors = compute_form_factors(traced.mesh, {}, monitor);
  const auto transport = cpu_operators().make("dense", traced.form_factors);
  traced.radiosity = solve(*cpu_solvers().make("cg", {*transport, traced.mesh->area.cwiseSqrt(), {}}),
                           traced.mesh->emission);
  return traced;
}

/// Relative error of B against E + rho f <E> / (1 - rho f), in the area norm.
double error_of(const Traced& traced, double f, double reflectance) {
  const PatchMesh& mesh = *traced.mesh;
  const double mean = mesh.area.dot(mesh.emission.col(0)) / mesh.area.sum();
  const Eigen::VectorXd exact = mesh.emission.col(0).array() + reflectance * f * mean / (1 - reflectance * f);
  const Eigen::VectorXd root = mesh.area.cwiseSqrt();
  return root.cwiseProduct(traced.radiosity.col(0) - exact).norm() / root.cwiseProduct(exact).norm();
}

TEST(TracedSphere, ApproachesTheClosedForm) {
  for (const double reflectance : {0.5, 0.9}) {
    const auto error = [&](int rings) {
      return error_of(solved(fmt::format("sphere-cavity:rings={},reflectance={}", rings, reflectance)), 1,
                      reflectance);
    };
    const double coarse = error(6), fine = error(12);
    EXPECT_LT(fine, 0.6 * coarse) << reflectance;
    EXPECT_LT(fine, 0.03) << reflectance;
  }
}

TEST(TracedBowl, ApproachesTheClosedForm) {
  for (const int beta : {45, 90}) {
    const double f = (1 - std::cos(beta * M_PI / 180)) / 2;
    const auto error = [&](int rings) {
      return error_of(solved(fmt::format("bowl:beta={},rings={},reflectance=0.8", beta, rings)), f, 0.8);
    };
    const double coarse = error(4), fine = error(8);
    EXPECT_LT(fine, 0.6 * coarse) << beta;
    EXPECT_LT(fine, 0.03) << beta;
  }
}

TEST(TracedSphere, AWrongShareOfLightIsNoticed) {
  EXPECT_GT(error_of(solved("sphere-cavity:rings=12,reflectance=0.9"), 0.9, 0.9), 0.1);
}

}  // namespace
}  // namespace radiosity
