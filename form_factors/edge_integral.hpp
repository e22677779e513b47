#pragma once

#include <Eigen/Core>

namespace radiosity {

/// The double integral of ln |x - y| over two straight edges, x from a0 to a1 and y from b0 to b1, both by
/// arc length. Parallel edges and edges that meet (a shared edge, a shared vertex, a T-junction) are done in
/// closed form; the rest by Gauss-Legendre quadrature of the inner closed form, cut where it comes near a
/// singularity, so that the error stays below about `tolerance` times the product of the lengths. Lengths are
/// of order 1: scale before.
double edge_log_integral(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
                         const Eigen::Vector3d& b1, double tolerance);

}  // namespace radiosity
