#pragma once

#include "form_factors/ray_packet.hpp"
#include "kernels/instruction_set.hpp"

#include <cstdint>

namespace radiosity {

/// Flat arrays over patches; the loops over them are compiled once for each instruction set, so nothing but
/// plain pointers may appear here. Without fused multiply-add (-ffp-contract=off) all of them give the same
/// bits.
struct PatchArrays {
  const double* corner_x[4];
  const double* corner_y[4];
  const double* corner_z[4];  ///< a triangle repeats its last corner
  const double* normal_x;
  const double* normal_y;
  const double* normal_z;
  const double* offset;
  const double* center_x;
  const double* center_y;
  const double* center_z;
};

/// Quadrature points: entry q * stride + patch. Weights include the area.
struct PointArrays {
  const double* x;
  const double* y;
  const double* z;
  const double* weight;
  int stride;
};

/// Room for a cluster.
struct PairHeights {
  static constexpr int capacity = 64;
  double other_low[capacity];  ///< lowest corner of j above the plane of i
  double other_high[capacity];
  double own_low[capacity];  ///< lowest corner of i above the plane of j
  double own_high[capacity];
  double distance_squared[capacity];
};

/// A patch as a map from the unit square, float32: x(u, v) = corner + u a + v b + u v d with the area density
/// jacobian + u slope_u + v slope_v (relative to the patch's area). A triangle has b = 0 and takes sqrt(u)
/// for u.
struct PatchChart {
  float corner[3], a[3], b[3], d[3], normal[3];
  float jacobian, slope_u, slope_v;
  int triangle;
};

/// Four coordinates of sixteen points of a Sobol net, to be combined with `high` by exclusive or.
struct SobolNet {
  alignas(64) std::uint32_t low[4][16];
};

/// A convex polygon of up to 4 corners as planes: its own and one through each edge, inside where all are >=
/// 0.
struct BlockerPlanes {
  double normal[3];
  double offset;
  double edge_normal[4][3];  ///< towards the inside, in the plane; a triangle repeats its last edge
  double edge_offset[4];
};

struct VectorLoops {
  void (*classify)(const PatchArrays&, int i, int begin, int end, PairHeights&);
  void (*exchange)(const PatchArrays&, const PointArrays& own_rule, int own_points,
                   const PointArrays& other_rule, int other_points, int i, int begin, int end,
                   double* result);
  /// crosses[l] = 1 (else 0) where the segment between the centres of i and begin + l passes through the
  /// polygon.
  void (*crosses)(const PatchArrays&, const BlockerPlanes&, int i, int begin, int end, double* crosses);
  /// below[l] = 1 (else 0) where all corners of patch begin + l lie below `limit` along a direction.
  void (*below)(const PatchArrays&, const double* direction, double limit, int begin, int end, double* below);
  void (*fill)(const PatchChart& from, const PatchChart& to, const SobolNet& net, const std::uint32_t* high,
               RayPacket& packet, float* weight);
  void (*tally)(const RayPacket& packet, const float* weight, double* visible, double* all);
};

VectorLoops vector_loops(InstructionSet instructions);

}  // namespace radiosity
