#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `dxt:bounces=1,exact=0.04,reorder=both,codec=bc1,range=25,fill=0`: the compressed matrix of document 000,
/// Section 3.5. The largest of each row and channel are kept exactly, the rest in blocks of texels whose
/// codes are logarithms, in an order in which similar rows and columns are neighbours.
///   bounces   1: F^c, as an operator for solvers; k or inf: S_k - I, E -> B by one product (Section 3.4)
///   matrix    colour, the document's, one matrix a channel; kernel: the symmetric kernel that all channels
///             share, of which half is stored, as an operator for solvers (not bc1)
///   exact     part of each row kept in float32 with its column
///   reorder   none, morton, rows, both (rows, then columns), 2opt; start=random shuffles first (with a seed)
///   codec     bc1, bc4, u8, u4, f16, bf16
///   map       log or linear codes
///   range     natural logarithms that codes span; auto: what the numbers span
///   fill      1: texels of exact entries may be anything, which spares their neighbours
///   fit       range or cluster: how BC1 blocks are fitted
std::unique_ptr<LinearOperator> make_dxt_operator(Spec& spec, const FormFactors& form_factors);

}  // namespace radiosity
