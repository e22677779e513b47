#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/element_partition.hpp"
#include "operators/linear_operator.hpp"

#include <memory>

namespace radiosity {

/// `2msc:k=64,mesh=adaptive|uniform,assign=inclusion|proximity,sides=one|two,storage=f32|f64`: two meshes
/// with spatial coherence (document 004, Algorithm 1 and Equation 6) with U from the assembled F. sides=one
/// keeps both U and V in full, as the original method does (`sparse-v` is the same operator with V sparse);
/// two is the symmetric variant T P + P T - P T P, P the mean over each patch: K W W' + W W' K - W W' K W W'
/// with one stored factor (operators/two_sided_operator.hpp).
/// k counts at most n.
std::unique_ptr<LinearOperator> make_two_mesh_operator(Spec& spec, const FormFactors& form_factors);

/// `sparse-v:k=64,mesh=...,assign=...,storage=...,factors=sums|direct`: the same with sides=one and V sparse
/// (operators/sparse_v_operator.hpp). factors=direct,tolerance=1e-3,seed=1 computes U from form factors
/// between elements and patches and needs no F (operators/direct_two_mesh.hpp).
std::unique_ptr<LinearOperator> make_sparse_v_operator(Spec& spec, const FormFactors& form_factors);

/// F_ep / A_p, or F_ep / c_p where elements are equal in area, n x k by element in the order of the mesh: U
/// of Equation 6.
Eigen::MatrixXd two_mesh_left_factor(const FormFactors& form_factors, const ElementPartition& partition);

}  // namespace radiosity
