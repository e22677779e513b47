// The baseline that every other method has to beat (methods.md, "Solvers"): products in a closed room of 864
// patches.

#include "form_factors/form_factors.hpp"
#include "operators/operator_registry.hpp"
#include "scene/built_in.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

#include <map>

namespace radiosity::testing {
namespace {

class CubeProducts : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    SilentMonitor monitor;
    auto mesh = std::make_shared<PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 864}));
    form_factors_ = std::make_unique<FormFactors>(compute_form_factors(mesh, {}, monitor));
  }
  static void TearDownTestSuite() { form_factors_.reset(); }

  static int products(const std::string& spec, double reflectance) {
    const auto transport = cpu_operators().make("dense", *form_factors_);
    dynamic_cast<KernelOperator&>(*transport)
        .set_reflectance(Eigen::MatrixXd::Constant(transport->size(), transport->channels(), reflectance));
    const auto solver = cpu_solvers().make(spec, {*transport, form_factors_->mesh->area.cwiseSqrt(), {}});
    solve(*solver, form_factors_->mesh->emission);
    return solver->products();
  }

  static inline std::unique_ptr<FormFactors> form_factors_;
};

TEST_F(CubeProducts, KrylovSolversTakeTenToFourteenAndOneToCheck) {
  const std::map<double, int> table = {{0.8, 10}, {0.95, 12}, {0.99, 13}, {0.999, 14}};
  for (const auto& [reflectance, count] : table) {
    for (const std::string spec : {"cg", "gmres"}) {
      EXPECT_LE(products(spec, reflectance), count + 1) << spec << " at " << reflectance;
      EXPECT_GE(products(spec, reflectance), count - 3) << spec << " at " << reflectance;
    }
  }
}

TEST_F(CubeProducts, StationarySolversTakeWhatTheTableSays) {
  const std::map<double, std::pair<int, int>> table = {
      {0.8, {53, 28}}, {0.95, {231, 118}}, {0.99, {1177, 599}}};
  for (const auto& [reflectance, counts] : table) {
    EXPECT_NEAR(products("neumann", reflectance), counts.first, 0.15 * counts.first + 3) << reflectance;
    EXPECT_NEAR(products("gauss-seidel", reflectance), counts.second, 0.15 * counts.second + 4)
        << reflectance;
  }
}

}  // namespace
}  // namespace radiosity::testing
