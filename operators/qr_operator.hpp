#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `qr:k=64,norm=plain|area,storage=f32|f64,columns=2msc|pivoted`: U, an orthonormal basis of k columns, and
/// V = F' U (document 004, section 3.2, without reflectances); in the area norm of K. `columns` says where
/// the basis comes from: `2msc` takes U of the two-mesh method, with its keys mesh=, assign=, ...
/// (operators/element_partition.hpp); `pivoted`, with seed=1, the columns of F that QR with column pivoting
/// picks (factorizations/leading_columns.hpp), at about 2.25 k products and no n x n matrix.
std::unique_ptr<LinearOperator> make_qr_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
