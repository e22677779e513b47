#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `quantized:bits=4,block=32,exact=0.01,diffusion=1`: the symmetric kernel in codes of 8, 4 or 2 bits, a
/// step for every 16, 32 or 64 consecutive entries of a row, the given fraction of entries in float32 beside
/// them, and the error of rounding an entry passed on to its neighbours (compression/quantize.hpp). Throws
/// UsageError for unsymmetric form factors.
std::unique_ptr<LinearOperator> make_quantized_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
