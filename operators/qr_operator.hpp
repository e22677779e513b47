#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `qr:k=64,norm=plain|area,storage=f32|f64,columns=pivoted,seed=1`: U, an orthonormal basis of k columns of
/// F, and V = F' U (document 004, section 3.2, without reflectances); in the area norm of K. `columns` says
/// where the basis comes from: `pivoted` takes the columns that QR with column pivoting picks
/// (factorizations/leading_columns.hpp). Costs about 2.25 k products, O(n k^2) and no n x n matrix.
std::unique_ptr<LinearOperator> make_qr_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
