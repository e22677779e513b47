#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `dense`, `dense:f32`, `dense:f16`: every entry, in double (default), float32 or binary16.
/// Symmetric form factors give a KernelOperator; f64 then shares their kernel instead of copying it.
/// Unsymmetric ones (gather) give T = R F with the full F, which knows its transpose too.
std::unique_ptr<LinearOperator> make_dense_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
