#include "gpu/gl_operators.hpp"

#include "gpu/upload.hpp"

#include <optional>
#include <utility>

namespace radiosity {
namespace {

std::optional<RowStrategy> take_strategy(Spec& spec) {
  const std::string strategy = spec.choice("strategy", "auto", {"auto", "group", "invocation"});
  if (strategy == "group") return RowStrategy::group;
  if (strategy == "invocation") return RowStrategy::invocation;
  return std::nullopt;
}

}  // namespace

OperatorRegistry gl_operators(const std::shared_ptr<GlDevice>& device, const OperatorRegistry& cpu) {
  OperatorRegistry registry;
  for (OperatorEntry entry : cpu.entries()) {
    entry.make = [make = entry.make, device](Spec& spec, const FormFactors& form_factors) {
      require_uploadable(spec.name());
      const std::optional<RowStrategy> strategy = take_strategy(spec);
      return upload(device, *make(spec, form_factors), strategy);
    };
    registry.add(std::move(entry));
  }
  return registry;
}

}  // namespace radiosity
