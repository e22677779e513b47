#include "operators/quantized_kernel_operator.hpp"

#include "foundation/error.hpp"
#include "operators/kernel_error.hpp"
#include "operators/rounding_certificate.hpp"
#include "operators/storage_choice.hpp"

#include <utility>

namespace radiosity {

QuantizedKernelOperator::QuantizedKernelOperator(const FormFactors& form_factors, QuantizedTiles tiles,
                                                 std::string spec)
    : KernelOperator(form_factors), tiles_(std::move(tiles)), spec_(std::move(spec)) {
  certificate_ = approximation_certificate(kernel_error(*form_factors.kernel, tiles_, root_area()),
                                           product_rounding<float>(size()), reflectance(), root_area());
}

ByteCount QuantizedKernelOperator::bytes() const {
  return {{{"codes", tiles_.code_bytes()},
           {"steps", tiles_.step_bytes()},
           {"exact", tiles_.exact_bytes()},
           {"directory", tiles_.directory_bytes()},
           {"diagonals", diagonal_bytes(size(), channels())}}};
}

void require_symmetric_kernel(const FormFactors& form_factors, const std::string& operator_name) {
  if (!form_factors.symmetric())
    fail<UsageError>(
        "{} needs a symmetric kernel, which form factors by '{}' do not have: use accurate or one-ray",
        operator_name, form_factors.quality.method);
}

}  // namespace radiosity
