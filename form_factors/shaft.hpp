#pragma once

#include "form_factors/convex_polygon.hpp"
#include "form_factors/vector_loops.hpp"

#include <Eigen/Core>

#include <span>

namespace radiosity {

/// One end of a shaft: a convex set given by points whose hull contains it.
using ShaftEnd = std::span<const Eigen::Vector3d>;

/// A face that may stand in the way, with its plane.
struct Blocker {
  explicit Blocker(const ConvexPolygon& face);

  ConvexPolygon polygon;
  Plane plane;
  Eigen::Vector3d center;
  BlockerPlanes planes;
};

/// Proves, by a separating plane, that a blocker cannot come between any point of one end and any point of
/// the other. Never wrong when true; false means "perhaps".
bool misses_shaft(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second);

/// The same for ends of which no segment from middle to middle is known to be cut: looks for a direction
/// along which the whole blocker lies beyond both ends, and returns it (unit length) in `direction`.
bool separate(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second,
              Eigen::Vector3d& direction);

/// The lowest point of a blocker along a direction.
double lowest(const Eigen::Vector3d& direction, const Blocker& blocker);

/// Proves that a blocker comes between every point of one end and every point of the other: it does as soon
/// as it cuts all the segments from corner to corner, since every other crossing is a convex combination of
/// those.
bool blocks_shaft(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second);

}  // namespace radiosity
