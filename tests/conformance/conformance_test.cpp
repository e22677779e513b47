#include "foundation/error.hpp"
#include "operators/operator_checks.hpp"
#include "operators/operator_registry.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace radiosity {
namespace {

struct Parameters {
  std::string spec;
  bool lossy;
  Index size;
};

void PrintTo(const Parameters& parameters, std::ostream* out) {
  *out << parameters.spec << ", n = " << parameters.size;
}

/// Every registered operator with its defaults and its variants: a new line in the registry is tested without
/// an edit here.
std::vector<Parameters> all_parameters() {
  std::vector<Parameters> all;
  const OperatorRegistry registry = cpu_operators();
  for (const OperatorEntry& entry : registry.entries()) {
    std::vector<std::string> specs = {entry.defaults};
    specs.insert(specs.end(), entry.variants.begin(), entry.variants.end());
    for (const std::string& spec : specs)
      for (const Index n : {0, 1, 2, 3, 5, 6, 17, 33, 64, 65, 130}) all.push_back({spec, entry.lossy, n});
  }
  return all;
}

/// Unit roundoff of the storage that a spec names.
double storage_roundoff(const std::string& spec) {
  if (spec.find("f16") != std::string::npos) return 0x1p-11;
  return spec.find("f32") != std::string::npos ? 0x1p-24 : 0x1p-53;
}

/// Null where a lossy operator says that it needs a symmetric kernel.
std::unique_ptr<LinearOperator> make(const Parameters& parameters, const FormFactors& form_factors) {
  const OperatorRegistry registry = cpu_operators();
  if (form_factors.symmetric() || !parameters.lossy) return registry.make(parameters.spec, form_factors);
  try {
    return registry.make(parameters.spec, form_factors);
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("symmetric kernel"), std::string::npos) << error.what();
    return nullptr;
  }
}

std::string parameter_name(const testing::TestParamInfo<Parameters>& info) {
  std::string name = info.param.spec + "_" + std::to_string(info.param.size);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

class Conformance : public testing::TestWithParam<Parameters> {};

TEST_P(Conformance, DoesWhatEveryOperatorMust) {
  for (TransportCase& data : transport_cases(GetParam().size)) {
    SCOPED_TRACE(data.name);
    const auto transport = make(GetParam(), data.form_factors);
    if (!transport) continue;
    EXPECT_EQ(transport->size(), GetParam().size);
    EXPECT_EQ(transport->channels(), data.reference.channels());
    if (GetParam().lossy) {
      EXPECT_EQ(check_operator(*transport, own_entries(*transport)), "");
      EXPECT_EQ(check_certificate(*transport, data.reference, data.root_area), "");
    } else {
      allow_storage_error(data, storage_roundoff(GetParam().spec));
      EXPECT_EQ(check_operator(*transport, data.reference), "");
      EXPECT_EQ(check_certificate(*transport, data.reference, data.root_area), "");
    }
  }
}

TEST_P(Conformance, DescribesItselfSoThatTheRegistryBuildsItAgain) {
  const OperatorRegistry registry = cpu_operators();
  for (const TransportCase& data : transport_cases(GetParam().size)) {
    const auto transport = make(GetParam(), data.form_factors);
    if (!transport) continue;
    const auto again = registry.make(transport->describe(), data.form_factors);
    EXPECT_EQ(again->describe(), transport->describe());
    EXPECT_EQ(again->bytes().parts, transport->bytes().parts);
    EXPECT_EQ(again->symmetric(), transport->symmetric());
    if (!GetParam().lossy) {
      EXPECT_EQ(transport->symmetric(), data.form_factors.symmetric());
    }
    const Field X = Field::Ones(transport->size(), transport->channels());
    Field Y(X.rows(), X.cols());
    Field Z(X.rows(), X.cols());
    transport->apply(X, Y);
    again->apply(X, Z);
    EXPECT_EQ(Y, Z);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, Conformance, testing::ValuesIn(all_parameters()), parameter_name);

}  // namespace
}  // namespace radiosity
