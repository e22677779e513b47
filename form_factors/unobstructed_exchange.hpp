#pragma once

#include "form_factors/patch_geometry.hpp"

#include <array>

namespace radiosity {

/// A_i F_ij with nothing in between, in the scaled scene: product quadrature where patches are well apart,
/// the contour integral where they are close, touch, or reach behind each other's plane (after clipping by
/// the horizon).
class UnobstructedExchange {
 public:
  /// `tolerance` is relative to A_i A_j / (pi d^2); geometry must outlive this.
  UnobstructedExchange(const PatchGeometry& geometry, double tolerance);

  /// exchange[j - cluster.begin] for all patches j of a cluster; exactly 0 for pairs that do not face each
  /// other.
  void with_cluster(int i, const PatchCluster& cluster, double* exchange) const;

  /// One pair, however close, by clipping and the contour integral.
  double by_contour(int i, int j) const;

 private:
  const PatchGeometry& geometry_;
  double tolerance_;
  // The lowest order for a patch of this radius at this distance; QuadraturePoints::orders if none will do.
  int order_for(double radius, double distance_squared, bool triangles) const;

  std::array<std::array<double, QuadraturePoints::orders>, 2> least_ratio_;  ///< [any triangle][order]
};

}  // namespace radiosity
