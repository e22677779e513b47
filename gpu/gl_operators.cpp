#include "gpu/gl_operators.hpp"

#include "gpu/upload.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace radiosity {
namespace {

/// Of those that have rows to share out.
std::optional<RowStrategy> take_strategy(Spec& spec) {
  constexpr std::array<std::string_view, 4> names = {"dense", "csr", "bounces", "dxt"};
  if (std::find(names.begin(), names.end(), spec.name()) == names.end()) return std::nullopt;
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
