#pragma once

#include "compression/colour_compression.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

#include <memory>
#include <string>

namespace radiosity {

/// The symmetric kernel, compressed with the steps of document 000 (compression/colour_compression.hpp) but
/// once for all channels, its upper triangle alone, in an order of its own. `spec` is what describe() gives.
/// Its certificate is proved while it is made, entry by entry. Throws UsageError for unsymmetric form
/// factors.
std::unique_ptr<LinearOperator> make_compressed_kernel(const ColourCompressionOptions& options,
                                                       const TexelOrder& row_order, const std::string& spec,
                                                       const FormFactors& form_factors);

}  // namespace radiosity
