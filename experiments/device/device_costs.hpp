#pragma once

#include "experiments/device/device_results.hpp"
#include "gpu/gl_device.hpp"
#include "operators/operator_registry.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiosity {

struct ProductCostOptions {
  Index patches = 4096;             ///< of dense and compressed products, about
  LowRankSize factors{55296, 216};  ///< of products with factors
  double seconds = 0.5;             ///< for each product on each side
  std::uint64_t seed = 1;
};

/// Measures what products of the same format take of the processor by the kernels of the CPU and on the
/// device: dense in float32 and binary16, two full factors, BC1 blocks for one channel and for three.
/// `form_factors` are of a scene with three channels: what is compressed, and what is kept apart, depends on
/// it.
std::vector<ProductCost> measure_product_costs(const std::shared_ptr<GlDevice>& device,
                                               const FormFactors& form_factors,
                                               const ProductCostOptions& options,
                                               const OperatorRegistry& cpu);

}  // namespace radiosity
