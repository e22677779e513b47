#pragma once

#include "gpu/gl_device.hpp"
#include "operators/linear_operator.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Where the factors of an operator of low rank are: both on the device, or V on the CPU (HybridFactors).
enum class Placement { device, hybrid };

/// The same operator on the device, compared there with `original` by one product with a random field, which
/// must agree to the rounding of both. `strategy`: empty for the device's own. `placement`
/// is for operators of low rank as U V'. Throws UsageError, in a
/// sentence that lists what can be copied, for operators that cannot, and Error where the device has no room
/// for it or computes something else.
std::unique_ptr<LinearOperator> upload(const std::shared_ptr<GlDevice>& device,
                                       const LinearOperator& original,
                                       std::optional<RowStrategy> strategy = {},
                                       Placement placement = Placement::device);

/// The largest |difference| of a component of their products with a random field, relative to the largest
/// component. Throws Error, naming the renderer, where it is more than the rounding of float32 products.
double compare_products(const LinearOperator& original, const LinearOperator& copy,
                        const std::string& renderer);

/// What upload() takes, as specs: "dense:f32", "dense:f16", ...
const std::vector<std::string>& uploadable_specs();

/// Throws UsageError, in a sentence that lists those specs, unless one of them has the name of `spec`.
void require_uploadable(const std::string& spec);

}  // namespace radiosity
