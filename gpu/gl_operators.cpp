#include "gpu/gl_operators.hpp"

#include "foundation/error.hpp"
#include "gpu/upload.hpp"
#include "operators/global_operator.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace radiosity {
namespace {

std::optional<RowStrategy> take_strategy(Spec& spec) {
  const std::string strategy = spec.choice("strategy", "auto", {"auto", "group", "invocation"});
  if (strategy == "group") return RowStrategy::group;
  if (strategy == "invocation") return RowStrategy::invocation;
  return std::nullopt;
}

/// Of those that have factors.
Placement take_placement(Spec& spec) {
  constexpr std::array<std::string_view, 8> names = {"svd",      "rsvd", "qr",      "2msc",
                                                     "sparse-v", "cur",  "wavelet", "dct"};
  if (std::find(names.begin(), names.end(), spec.name()) == names.end()) return Placement::device;
  return spec.choice("placement", "device", {"device", "hybrid"}) == "hybrid" ? Placement::hybrid
                                                                              : Placement::device;
}

/// Of those that have blocks; the key is another one with closure=blocks.
BlockPlacement take_blocks(Spec& spec) {
  if (spec.name() != "dxt" || spec.text("closure", "none") == "blocks") return BlockPlacement::buffer;
  return spec.choice("blocks", "buffer", {"buffer", "texture"}) == "texture" ? BlockPlacement::texture
                                                                             : BlockPlacement::buffer;
}

/// What is copied to a device: the operator of the CPU, or its global operator.
std::unique_ptr<LinearOperator> make_original(const OperatorEntry& on_cpu, Spec& spec,
                                              const FormFactors& form_factors) {
  const bool global = !on_cpu.makes_global && spec.flag("global");
  auto made = on_cpu.make(spec, form_factors);
  return global ? std::make_unique<GlobalOperator>(std::move(made)) : std::move(made);
}

}  // namespace

OperatorRegistry gl_operators(const std::shared_ptr<GlDevice>& device, const OperatorRegistry& cpu) {
  OperatorRegistry registry;
  for (OperatorEntry entry : cpu.entries()) {
    entry.make = [on_cpu = entry, device](Spec& spec, const FormFactors& form_factors) {
      require_uploadable(spec.name());
      const UploadChoice choice{take_strategy(spec), take_placement(spec), take_blocks(spec)};
      return upload(device, *make_original(on_cpu, spec, form_factors), choice);
    };
    entry.makes_global = true;
    registry.add(std::move(entry));
  }
  return registry;
}

void require_no_device_keys(const std::string& spec_text) {
  Spec spec = Spec::parse(spec_text);
  for (const char* key : {"strategy", "placement", "blocks"}) {
    const std::string value = spec.text(key, "");
    const bool of_closure = key == std::string_view("blocks") && value != "buffer" && value != "texture";
    if (!value.empty() && !of_closure)
      fail<UsageError>("'{}': {}={} is for operators on a device: take --device gl, or leave it away",
                       spec_text, key, value);
  }
}

}  // namespace radiosity
