#include "operators/on_demand_kernel.hpp"
#include "operators/operator_registry.hpp"
#include "scene/import.hpp"
#include "solvers/sampled_certificate.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

std::shared_ptr<const PatchMesh> patches_of(const std::string& scene, Index patches) {
  return std::make_shared<const PatchMesh>(make_patches(open_scene(scene), {.patches = patches}));
}

FormFactors form_factors(const std::shared_ptr<const PatchMesh>& mesh, const FormFactorOptions& options) {
  SilentMonitor monitor;
  return compute_form_factors(mesh, options, monitor);
}

TEST(OnDemandKernel, IsTheAssembledOne) {
  const auto mesh = patches_of("cornell-box", 90);
  const OnDemandKernel on_demand(mesh);
  const auto stored = cpu_operators().make("dense", form_factors(mesh, {.closure = Closure::none}));
  const Field X = mesh->area.array().sin().matrix() * Eigen::RowVectorXd::LinSpaced(3, 1, 3);
  Field Y(X.rows(), 3), Z(X.rows(), 3);
  on_demand.apply(X, Y);
  stored->apply(X, Z);
  EXPECT_LE((Y - Z).cwiseAbs().maxCoeff(), 1e-14 * Z.cwiseAbs().maxCoeff());
  EXPECT_TRUE(on_demand.symmetric());
}

TEST(OnDemandKernel, IsSolvedByAFewProductsWithACompressedOneOfCheapFormFactors) {
  // The stored operator: 4 bits, one ray a pair. The true one: never stored.
  const auto mesh = patches_of("cornell-box", 150);
  const FormFactors cheap = form_factors(mesh, {.method = FormFactorMethod::one_ray});
  const OnDemandKernel truth(mesh);
  const auto solver =
      cpu_solvers().make("cg:preconditioner=quantized",
                         {truth, truth.root_area(), {.tolerance = 1e-6}, [&](const std::string& spec) {
                            return cpu_operators().make(spec, cheap);
                          }});
  const Field answer = solve(*solver, mesh->emission);
  EXPECT_LE(solver->products(), 9);

  const auto stored = cpu_operators().make("dense", form_factors(mesh, {.closure = Closure::none}));
  const auto reference = cpu_solvers().make("cg", {*stored, truth.root_area(), {.tolerance = 1e-10}});
  const Field exact = solve(*reference, mesh->emission);
  EXPECT_LE((answer - exact).norm(), 2e-6 * exact.norm());
  const auto cheap_only = cpu_operators().make("quantized", cheap);
  const auto uncorrected = cpu_solvers().make("cg", {*cheap_only, truth.root_area(), {}});
  EXPECT_GE((solve(*uncorrected, mesh->emission) - exact).norm(), 1e-3 * exact.norm());

  const ErrorBound bound =
      sampled_error_bound(mesh->area, mesh->reflectance, [&](Index i) { return truth.rows().row(i); },
                          mesh->emission, answer, {.rows = 48});
  EXPECT_GE(bound.relative[0], (answer - exact).norm() / exact.norm());
  EXPECT_LE(bound.relative[0], 1e-4);
}

}  // namespace
}  // namespace radiosity
