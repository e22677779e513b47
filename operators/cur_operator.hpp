#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `cur:k=64,norm=plain|area,storage=f32|f64,core=projection|interpolation,seed=1`: k columns and k rows of
/// F, or in the area norm of K, and a k x k matrix between them (document 004, section 3.2;
/// factorizations/cur.hpp), multiplied out to two factors of n x k. core=projection is never worse in its
/// norm and costs k products more.
std::unique_ptr<LinearOperator> make_cur_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
