#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `dct:k=64,norm=plain|area,storage=f32|f64,seed=1`: F ~ (F V) V' where V spans the k functions of the
/// discrete cosine transform (DCT-II, in two dimensions on each plane of the scene) that carry most of F, or
/// in the area norm of K (document 004, section 3.2; factorizations/function_family.hpp): on the Cornell box
/// (n = 3294, k = 206) this halves the error in B that one cosine series along the order of the patches
/// gives. bytes() includes V, though it could be computed.
std::unique_ptr<LinearOperator> make_dct_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
