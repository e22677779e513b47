#pragma once

#include "form_factors/convex_polygon.hpp"

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
};

/// Proves, by a separating plane, that a blocker cannot come between any point of one end and any point of
/// the other. Never wrong when true; false means "perhaps". `direction` is where to look first (the plane's
/// normal, any length; zero: no idea) and becomes the one that separated: neighbouring pairs are mostly
/// separated by the same plane.
bool misses_shaft(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second,
                  Eigen::Vector3d& direction);

/// Proves that a blocker comes between every point of one end and every point of the other: it does as soon
/// as it cuts all the segments from corner to corner, since every other crossing is a convex combination of
/// those.
bool blocks_shaft(const Blocker& blocker, const ShaftEnd& first, const ShaftEnd& second);

}  // namespace radiosity
