#pragma once

#include "gpu/texture_on_device.hpp"
#include "operators/linear_operator.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Where the factors of an operator of low rank are: both on the device, or V on the CPU (HybridFactors).
enum class Placement { device, hybrid };

/// How an operator is to be on a device.
struct UploadChoice {
  std::optional<RowStrategy> strategy = {};        ///< empty: the device's own
  Placement placement = Placement::device;         ///< for operators of low rank as U V'
  BlockPlacement blocks = BlockPlacement::buffer;  ///< for `dxt` with BC1 blocks
};

/// The same operator on the device, compared there with `original` by one product with a random field, which
/// must agree to the rounding of both, and to what texture units round where they decode. Throws UsageError,
/// in a sentence that lists what can be copied, for operators that cannot, and Error where the device has no
/// room for it or computes something else.
std::unique_ptr<LinearOperator> upload(const std::shared_ptr<GlDevice>& device,
                                       const LinearOperator& original, const UploadChoice& choice = {});

/// The largest |difference| of a component of their products with a random field, all of whose components are
/// in [0, 1), relative to the largest component. Throws Error, naming the renderer, where one of a component
/// is more than the rounding of products and `allowed` (n x channels; empty: 0).
double compare_products(const LinearOperator& original, const LinearOperator& copy,
                        const std::string& renderer, const Eigen::MatrixXd& allowed = {});

/// What upload() takes, as specs: "dense:f32", "dense:f16", ...
const std::vector<std::string>& uploadable_specs();

/// Throws UsageError, in a sentence that lists those specs, unless one of them has the name of `spec`.
void require_uploadable(const std::string& spec);

}  // namespace radiosity
