#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "tests/conformance/operator_checks.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace radiosity {
namespace {

struct Storage {
  std::string flag;
  double unit_roundoff;
};

/// Every registered operator with its defaults and with each storage that it knows. A new line in the
/// registry is tested without an edit here.
std::vector<std::pair<std::string, double>> specs_of(const OperatorEntry& entry) {
  std::vector<std::pair<std::string, double>> specs = {{entry.defaults, 0x1p-53}};
  const TransportCase smallest = transport_cases(1).front();
  for (const Storage& storage : {Storage{"f32", 0x1p-24}, Storage{"f16", 0x1p-11}}) {
    const std::string spec = entry.name + ":" + storage.flag;
    try {
      cpu_operators().make(spec, smallest.form_factors);
      specs.emplace_back(spec, storage.unit_roundoff);
    } catch (const UsageError&) {
      continue;  // this operator has no such storage
    }
  }
  return specs;
}

struct Parameters {
  std::string spec;
  double unit_roundoff;
  Index size;
};

void PrintTo(const Parameters& parameters, std::ostream* out) {
  *out << parameters.spec << ", n = " << parameters.size;
}

std::vector<Parameters> all_parameters() {
  std::vector<Parameters> all;
  const OperatorRegistry registry = cpu_operators();
  for (const OperatorEntry& entry : registry.entries())
    for (const auto& [spec, unit_roundoff] : specs_of(entry))
      for (const Index n : {0, 1, 2, 3, 5, 6, 17, 33, 64, 65, 130}) all.push_back({spec, unit_roundoff, n});
  return all;
}

std::string parameter_name(const testing::TestParamInfo<Parameters>& info) {
  std::string name = info.param.spec + "_" + std::to_string(info.param.size);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

class Conformance : public testing::TestWithParam<Parameters> {};

TEST_P(Conformance, DoesWhatEveryOperatorMust) {
  const OperatorRegistry registry = cpu_operators();
  for (TransportCase& data : transport_cases(GetParam().size)) {
    SCOPED_TRACE(data.name);
    allow_storage_error(data, GetParam().unit_roundoff);
    const auto transport = registry.make(GetParam().spec, data.form_factors);
    EXPECT_EQ(transport->size(), GetParam().size);
    EXPECT_EQ(transport->channels(), data.reference.channels());
    EXPECT_EQ(check_operator(*transport, data.reference, data.root_area), "");
  }
}

TEST_P(Conformance, DescribesItselfSoThatTheRegistryBuildsItAgain) {
  const OperatorRegistry registry = cpu_operators();
  for (const TransportCase& data : transport_cases(GetParam().size)) {
    const auto transport = registry.make(GetParam().spec, data.form_factors);
    const auto again = registry.make(transport->describe(), data.form_factors);
    EXPECT_EQ(again->describe(), transport->describe());
    EXPECT_EQ(again->bytes().parts, transport->bytes().parts);
    EXPECT_EQ(again->symmetric(), data.form_factors.symmetric());
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
