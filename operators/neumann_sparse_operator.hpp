#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `neumann-sparse:threshold=1e-05,bounces=1000`: E -> B by I + T + T^2 + ... with small entries dropped from
/// every power, as Kontkanen et al. (2006) and Lehtinen et al. (2008) make their global operators (document
/// 004, Section 2.2). An entry counts as the area norm sees it, A^{1/2} T A^{-1/2}, where T has norm below 1:
/// it is the share of a patch's light, scaled for unequal areas. Powers are taken until they vanish, or
/// `bounces` of them; G - I is stored in float32 by compressed rows, once a distinct reflectance. Building
/// takes up to O(n^3) a power. Throws Error where more than 4 GB a reflectance would have to be kept, or
/// light grows at every bounce.
std::unique_ptr<LinearOperator> make_neumann_sparse_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
