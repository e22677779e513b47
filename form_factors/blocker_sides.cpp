#include "form_factors/blocker_sides.hpp"

#include <algorithm>

namespace radiosity {
namespace {

BlockerSides sides_of(const ConvexPolygon& polygon, const Plane& plane,
                      const std::vector<Blocker>& blockers) {
  constexpr double touch = coplanar_slack;
  BlockerSides sides;
  for (std::size_t b = 0; b < blockers.size(); ++b) {
    double low = 1e300, high = -1e300, ahead = -1e300;
    for (const Eigen::Vector3d& corner : polygon.corners()) {
      const double height = blockers[b].plane.height(corner);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    for (const Eigen::Vector3d& corner : blockers[b].polygon.corners())
      ahead = std::max(ahead, plane.height(corner));
    if (ahead > touch) sides.ahead.add(b);
    if (low >= -touch) sides.above.add(b);
    if (high <= touch) sides.below.add(b);
  }
  return sides;
}

}  // namespace

BlockerSideTable::BlockerSideTable(const PatchGeometry& geometry, const std::vector<Blocker>& blockers) {
  if (blockers.size() > BlockerSet::capacity) return;
  for (int i = 0; i < geometry.patch_count(); ++i)
    patches_.push_back(sides_of(geometry.polygon(i), geometry.plane(i), blockers));
  for (const PatchCluster& cluster : geometry.clusters()) {
    BlockerSides all = patch(cluster.begin);
    for (int i = cluster.begin + 1; i < cluster.end; ++i) {
      all.ahead |= patch(i).ahead;
      all.above &= patch(i).above;
      all.below &= patch(i).below;
    }
    clusters_.push_back(all);
  }
}

}  // namespace radiosity
