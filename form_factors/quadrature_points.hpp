#pragma once

#include "form_factors/convex_polygon.hpp"
#include "form_factors/vector_loops.hpp"
#include "kernels/instruction_set.hpp"

#include <array>
#include <span>
#include <vector>

namespace radiosity {

/// Product quadrature for pairs of patches some way apart, over many patches at once. A quad has m x m
/// Gauss-Legendre points, a triangle a symmetric rule of about the same order (Dunavant 1985), at three
/// orders.
class QuadraturePoints {
 public:
  static constexpr int orders = 3;

  /// Patches in an order in which those of one cluster are neighbours.
  QuadraturePoints(std::span<const ConvexPolygon> polygons, std::span<const Plane> planes);

  /// From which ratio on, distance of the centres to the larger circumradius, the error of an order stays
  /// below `tolerance` times A_i A_j / (pi d^2). The constants are fitted to the contour integral over random
  /// pairs; a test holds them to it.
  static double least_ratio(int order, double tolerance, bool triangles);

  /// Heights and distances of patches begin ... end - 1 as seen from patch i.
  void classify(int i, int begin, int end, PairHeights& heights) const;

  /// exchange[j - begin] = A_i F_ij unobstructed for begin <= j < end, with points of one order on patch i
  /// and of another on the patches j; patches must face each other wholly.
  void exchange(int own_order, int other_order, int i, int begin, int end, double* exchange) const;

  const VectorLoops& loops() const { return loops_; }
  const PatchArrays& arrays() const { return arrays_; }

 private:
  VectorLoops loops_;
  std::vector<double> storage_;
  PatchArrays arrays_{};
  std::array<PointArrays, orders> points_{};
  std::vector<std::array<int, orders>> point_count_;
};

}  // namespace radiosity
