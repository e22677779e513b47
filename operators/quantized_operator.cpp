#include "operators/quantized_operator.hpp"

#include "compression/quantize.hpp"
#include "operators/quantized_kernel_operator.hpp"

#include <fmt/format.h>

namespace radiosity {

std::unique_ptr<LinearOperator> make_quantized_operator(Spec& spec, const FormFactors& form_factors) {
  QuantizeOptions options;
  options.bits = std::stoi(spec.choice("bits", "4", {"8", "4", "2"}));
  options.block = std::stoi(spec.choice("block", "32", {"16", "32", "64"}));
  options.exact = spec.number("exact", options.exact, 0, 1);
  options.diffusion = spec.flag("diffusion", options.diffusion);
  spec.finish();
  require_symmetric_kernel(form_factors, "quantized");
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  return std::make_unique<QuantizedKernelOperator>(
      form_factors, quantize(*form_factors.kernel, root_area, options),
      fmt::format("quantized:bits={},block={},exact={},diffusion={}", options.bits, options.block,
                  options.exact, options.diffusion ? 1 : 0));
}

}  // namespace radiosity
