#include "operators/operator_registry.hpp"

#include "foundation/error.hpp"

#include <fmt/ranges.h>

#include <utility>

namespace radiosity {

OperatorRegistry::OperatorRegistry(std::vector<OperatorEntry> entries) {
  for (OperatorEntry& entry : entries) add(std::move(entry));
}

void OperatorRegistry::add(OperatorEntry entry) {
  for (const OperatorEntry& other : entries_)
    if (other.name == entry.name) fail<UsageError>("there is already an operator named '{}'", entry.name);
  entries_.push_back(std::move(entry));
}

std::unique_ptr<LinearOperator> OperatorRegistry::make(const std::string& spec_text,
                                                       const FormFactors& form_factors) const {
  Spec spec = Spec::parse(spec_text);
  std::vector<std::string> names;
  for (const OperatorEntry& entry : entries_) {
    names.push_back(entry.name);
    if (entry.name != spec.name()) continue;
    auto made = entry.make(spec, form_factors);
    spec.finish();
    return made;
  }
  fail<UsageError>("there is no operator '{}' (in '{}'); known are {}", spec.name(), spec_text,
                   fmt::join(names, ", "));
}

}  // namespace radiosity
