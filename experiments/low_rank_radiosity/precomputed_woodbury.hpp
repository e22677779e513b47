#pragma once

#include "foundation/monitor.hpp"
#include "kernels/products.hpp"
#include "kernels/segments.hpp"
#include "operators/capacitance.hpp"

namespace radiosity {

/// (I - V' R U)' from V of n x k and U of n x k, made in double: rows of both are sorted by patch, and so are
/// the reflectances (n) of one channel. Throws UsageError where shapes do not fit and Error where I - V' R U
/// is singular to rounding.
CapacitanceMatrix transposed_capacitance(const Segments& V, const TallMatrix<float>& U,
                                         const Eigen::VectorXd& reflectance);

/// Y of B = E - Y (V' E), with which T = R U V' is solved in one step (document 004, Equation 5, with its Y =
/// -R U (I - V' R U)^-1), from U, n x k, in its place, for the channel of these reflectances (n, sorted by
/// patch). Y is rounded to float once. Takes some thousand rows in double and two matrices of k x k beside U.
/// Throws as transposed_capacitance().
TallMatrix<float> precompute_woodbury(const Segments& V, TallMatrix<float> U,
                                      const Eigen::VectorXd& reflectance, Monitor& monitor);

/// V with all its n k numbers, of which n are not zero: what the method stored before V was sparse.
TallMatrix<float> full_matrix(const Segments& V);

/// B = E - Y X, n x c from k x c: line 7 of document 004's Algorithm 2. B does not alias E.
void subtract_product(const TallMatrix<float>& Y, const ConstFieldRef& X, const ConstFieldRef& E, FieldRef B);

}  // namespace radiosity
