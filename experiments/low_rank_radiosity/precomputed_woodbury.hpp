#pragma once

#include "foundation/monitor.hpp"
#include "kernels/products.hpp"
#include "kernels/segments.hpp"

namespace radiosity {

/// Y of B = E - Y (V' E), with which T = R U V' is solved in one step (document 004, Equation 5, with its Y =
/// -R U (I - V' R U)^-1), from U, n x k, in its place: rows of V and U are sorted by patch, and so are the
/// reflectances (n) of the one channel that Y is right for. The capacitance matrix is made and factored in
/// double; Y is rounded to float once. Takes some thousand rows in double and two matrices of k x k beside U.
/// Throws UsageError where shapes do not fit and Error where I - V' R U is singular to rounding.
TallMatrix<float> precompute_woodbury(const Segments& V, TallMatrix<float> U,
                                      const Eigen::VectorXd& reflectance, Monitor& monitor);

/// V with all its n k numbers, of which n are not zero: what the method stored before V was sparse.
TallMatrix<float> full_matrix(const Segments& V);

/// B = E - Y X, n x c from k x c: line 7 of document 004's Algorithm 2. B does not alias E.
void subtract_product(const TallMatrix<float>& Y, const ConstFieldRef& X, const ConstFieldRef& E, FieldRef B);

}  // namespace radiosity
