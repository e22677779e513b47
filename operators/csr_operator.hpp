#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `csr`, `csr:f32`: the entries that are not exactly zero, by compressed rows, 16 of which share their
/// indices (kernels/row_groups.hpp), in double (default) or float32; products add up in double. A
/// KernelOperator for symmetric form factors (both halves of K are stored), else T = R F.
std::unique_ptr<LinearOperator> make_csr_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
