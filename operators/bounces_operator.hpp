#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `bounces:k=3,storage=f32`: E -> B of document 000 (Section 3.4, Eq. 8), the light after k reflections by
/// one product: S_k - I = sum over h = 1 ... k of (F^c)^h, stored in full, one n x n matrix for each distinct
/// channel, as f64, f32 or f16. k=inf is the sum of all bounces, (I - F^c)^-1 - I. Building takes O(n^3) a
/// bounce. Throws Error where the sum of all bounces does not exist.
std::unique_ptr<LinearOperator> make_bounces_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
