#include "operators/topk_operator.hpp"

#include "compression/keep_largest.hpp"
#include "operators/quantized_kernel_operator.hpp"

#include <fmt/format.h>

namespace radiosity {

std::unique_ptr<LinearOperator> make_topk_operator(Spec& spec, const FormFactors& form_factors) {
  const double fraction = spec.number("fraction", 0.1, 0, 1);
  spec.finish();
  require_symmetric_kernel(form_factors, "topk");
  return std::make_unique<QuantizedKernelOperator>(form_factors, keep_largest(*form_factors.kernel, fraction),
                                                   fmt::format("topk:fraction={}", fraction));
}

}  // namespace radiosity
