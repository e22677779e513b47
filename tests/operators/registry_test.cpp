#include "foundation/error.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_registry.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

FormFactors small_room() {
  return symmetric_form_factors(random_kernel(5, 1), Eigen::VectorXd::Ones(5),
                                Eigen::MatrixXd::Constant(5, 1, 0.5));
}

std::string error_of(const OperatorRegistry& registry, const std::string& spec) {
  try {
    registry.make(spec, small_room());
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(OperatorRegistry, UnknownNamesAndKeysAreErrorsThatListTheKnownOnes) {
  const OperatorRegistry registry = cpu_operators();
  EXPECT_EQ(
      error_of(registry, "dens").rfind("there is no operator 'dens' (in 'dens'); known are dense, csr", 0),
      0);
  EXPECT_EQ(error_of(registry, "dense:f8"),
            "'dense:f8': key 'f8' is not known; 'dense' knows closure, global, storage, f64, f32, f16");
  EXPECT_EQ(error_of(registry, "csr:f16"),
            "'csr:f16': key 'f16' is not known; 'csr' knows closure, global, storage, f64, f32");
  EXPECT_EQ(error_of(registry, "dense:f16,f32"),
            "'dense:f16,f32': storage is given more than once (f16, f32); choose one");
}

TEST(OperatorRegistry, EntriesDescribeThemselves) {
  const OperatorRegistry registry = cpu_operators();
  for (const OperatorEntry& entry : registry.entries()) {
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
    EXPECT_EQ(registry.make(entry.defaults, small_room())->describe(),
              registry.make(entry.name, small_room())->describe());
  }
}

TEST(OperatorRegistry, TakesAUsersOperatorOnce) {
  OperatorRegistry registry = cpu_operators();
  OperatorEntry mine = registry.entries().front();
  EXPECT_THROW(registry.add(mine), UsageError);
  mine.name = "mine";
  registry.add(mine);
  EXPECT_EQ(registry.make("mine:f32", small_room())->describe(), "dense:f32");
}

TEST(OperatorRegistry, RefusesFormFactorsThatDoNotFitTheirMesh) {
  const OperatorRegistry registry = cpu_operators();
  FormFactors wrong = small_room();
  wrong.kernel =
      symmetric_form_factors(random_kernel(4, 1), Eigen::VectorXd::Ones(4), Eigen::MatrixXd::Zero(4, 1))
          .kernel;
  EXPECT_THROW(registry.make("dense", wrong), UsageError);
  wrong.kernel = nullptr;
  EXPECT_THROW(registry.make("dense", wrong), UsageError);
  wrong.mesh = nullptr;
  EXPECT_THROW(registry.make("dense", wrong), UsageError);
}

}  // namespace
}  // namespace radiosity
