#pragma once

#include "form_factors/convex_polygon.hpp"

#include <Eigen/Core>

#include <span>

namespace radiosity {

/// One end of a shaft: a convex set given by points whose hull contains it, and the plane that it lies in, if it lies in one.
struct ShaftEnd {
  std::span<const Eigen::Vector3d> hull;
  const Plane* plane = nullptr;  ///< light leaves and arrives in front of it
};

/// Proves that a convex polygon cannot come between any point of one end and any point of the other. Never wrong when
/// true; false means "perhaps".
bool misses_shaft(const ConvexPolygon& blocker, const ShaftEnd& first, const ShaftEnd& second);

/// Proves that a convex polygon comes between every point of one end and every point of the other: it does as soon as it cuts
/// all the segments from corner to corner, since every other crossing is a convex combination of those.
bool blocks_shaft(const ConvexPolygon& blocker, const ShaftEnd& first, const ShaftEnd& second);

}  // namespace radiosity
