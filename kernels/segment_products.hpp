#pragma once

#include "kernels/segments.hpp"
#include "kernels/tall_matrix.hpp"

#include <Eigen/Core>

namespace radiosity {

/// (V' diag(d) U)', k x k, in one pass over U, n x k: column p is the sum of V_ep d_e U(e, :) over the rows e
/// of segment p, in double. `diagonal`, n, and the rows of U are sorted as V's are. The result is the same
/// for any number of threads. Throws UsageError where shapes do not fit. Scalar: double or float.
template <typename Scalar>
Eigen::MatrixXd transposed_segment_products(const Segments& V, const Eigen::VectorXd& diagonal,
                                            const TallMatrix<Scalar>& U);

}  // namespace radiosity
