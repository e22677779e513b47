#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `topk:fraction=0.1`: the largest entries of the symmetric kernel, at most this fraction of all, in
/// float32; the others are dropped (compression/keep_largest.hpp). Throws UsageError for unsymmetric form
/// factors.
std::unique_ptr<LinearOperator> make_topk_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
