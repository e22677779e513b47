#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `svd:k=64,norm=plain|area,storage=f32|f64,method=dense|lanczos`: the best approximation of F of rank k
/// (document 004). In the plain norm F = U S V' by LAPACK's dgesdd, kept as U S and V; in the area norm the
/// eigenpairs of the symmetric kernel K that are largest in magnitude, kept as one factor, with the first one
/// left out as certificate. Either costs O(n^3). method=lanczos finds the same from products, without a
/// certificate, or throws Error where it does not converge. k counts at most n.
std::unique_ptr<LinearOperator> make_svd_operator(Spec& spec, const FormFactors& form_factors);

/// `rsvd:k=64,norm=...,power=1,oversampling=10,seed=1,storage=...`: the same from a randomized SVD, which
/// takes (2 power + 2) (k + oversampling) products with F.
std::unique_ptr<LinearOperator> make_rsvd_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
