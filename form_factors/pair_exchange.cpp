#include "form_factors/pair_exchange.hpp"

#include "form_factors/shaft.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

// Quadrature is cheap: keep its error two digits below that of the sampling.
double quadrature_tolerance(double tolerance) {
  return std::clamp(0.01 * tolerance, 1e-14, 1e-6);
}

bool all_behind(const std::vector<Eigen::Vector3d>& points, const Plane& plane) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& p) { return plane.height(p) <= coplanar_slack; });
}

}  // namespace

PairExchange::PairExchange(const PatchMesh& mesh, double tolerance, std::uint64_t seed,
                           std::uint64_t least_rays)
    : geometry_(mesh),
      occluders_(coarse_faces(mesh, geometry_)),
      sides_(geometry_, occluders_.blockers()),
      unobstructed_(geometry_, quadrature_tolerance(tolerance)),
      visibility_(geometry_, occluders_, seed, least_rays),
      tolerance_(tolerance) {}

bool PairExchange::may_exchange(const PatchCluster& own, const PatchCluster& other) const {
  return !(own.coplanar && all_behind(other.hull, own.plane)) &&
         !(other.coplanar && all_behind(own.hull, other.plane));
}

ExchangeWorkspace PairExchange::make_workspace() const {
  return {std::vector<Eigen::Vector3d>(occluders_.blockers().size(), Eigen::Vector3d::Zero()), nullptr};
}

PairExchange::ClusterPair PairExchange::relate(const PatchCluster& own, const PatchCluster& other) const {
  ClusterPair pair;
  pair.other = &other;
  pair.nothing = !may_exchange(own, other);
  if (pair.nothing) return pair;
  pair.proofs = !sides_.empty();
  if (!pair.proofs) return pair;
  pair.candidates = between(sides_.cluster(own), sides_.cluster(other));
  pair.nothing = narrow(own.hull, other.hull, pair.candidates) == Shaft::blocked;
  return pair;
}

PairExchange::Shaft PairExchange::narrow(const ShaftEnd& first, const ShaftEnd& second,
                                         BlockerSet& candidates) const {
  BlockerSet left;
  bool blocked = false;
  candidates.for_each([&](std::size_t b) {
    const Blocker& blocker = occluders_.blockers()[b];
    if (misses_shaft(blocker, first, second)) return true;
    left.add(b);
    blocked = blocks_shaft(blocker, first, second);
    return !blocked;
  });
  candidates = left;
  if (blocked) return Shaft::blocked;
  return left.empty() ? Shaft::clear : Shaft::unknown;
}

void PairExchange::decide(int i, const PatchCluster& cluster, const BlockerSet& candidates,
                          ExchangeWorkspace& workspace, Shaft* shafts) const {
  const int count = cluster.end - cluster.begin;
  std::array<BlockerSet, PairHeights::capacity> of_pair;
  for (int l = 0; l < count; ++l) {
    of_pair[static_cast<std::size_t>(l)] = between(sides_.patch(i), sides_.patch(cluster.begin + l));
    shafts[l] = Shaft::clear;
  }
  std::array<unsigned char, PairHeights::capacity> open;
  candidates.for_each([&](std::size_t b) {
    for (int l = 0; l < count; ++l) {
      const auto at = static_cast<std::size_t>(l);
      open[at] = shafts[l] != Shaft::blocked && of_pair[at].has(b);
    }
    decide(i, cluster, b, workspace.separating[b], open.data(), shafts);
    return true;
  });
}

void PairExchange::decide(int i, const PatchCluster& cluster, std::size_t blocker_number,
                          Eigen::Vector3d& direction, unsigned char* open, Shaft* shafts) const {
  const int count = cluster.end - cluster.begin;
  const QuadraturePoints& patches = geometry_.quadrature();
  const Blocker& blocker = occluders_.blockers()[blocker_number];
  const auto own = geometry_.polygon(i).corners();
  std::array<double, PairHeights::capacity> answer;

  // A face that cuts the segment between two centres is in the way: of all of the pair, or of some.
  patches.loops().crosses(patches.arrays(), blocker.planes, i, cluster.begin, cluster.end, answer.data());
  for (int l = 0; l < count; ++l) {
    if (!open[l] || answer[static_cast<std::size_t>(l)] == 0) continue;
    const bool all = blocks_shaft(blocker, own, geometry_.polygon(cluster.begin + l).corners());
    shafts[l] = all ? Shaft::blocked : Shaft::unknown;
    open[l] = 0;
  }
  // A direction that separates one pair from the face separates most of its neighbours too.
  bool untried = direction.squaredNorm() > 0;
  for (int l = 0; l < count; ++l) {
    if (untried) {
      const double limit = lowest(direction, blocker) - coplanar_slack;
      double own_high = -1e300;
      for (const Eigen::Vector3d& corner : own) own_high = std::max(own_high, direction.dot(corner));
      if (own_high < limit) {
        patches.loops().below(patches.arrays(), direction.data(), limit, cluster.begin, cluster.end,
                              answer.data());
        for (int k = 0; k < count; ++k)
          if (answer[static_cast<std::size_t>(k)] != 0) open[k] = 0;
      }
      untried = false;
    }
    if (!open[l] || shafts[l] == Shaft::unknown) continue;  // another proof tells nothing of what needs rays
    Eigen::Vector3d found = direction;
    if (separate(blocker, own, geometry_.polygon(cluster.begin + l).corners(), found)) {
      direction = found;
      untried = true;
    } else {
      shafts[l] = Shaft::unknown;
    }
    open[l] = 0;
  }
}

// With groups g and h of the patches, sum_(i in g, j in h) A_i^2 var F_ij <= tolerance^2 A_g^2 (and the same
// from h's side) holds if var K_ij <= tolerance^2 min(A_g / A_h, A_h / A_g) for every pair: a bound that each
// pair can check alone. The other ratio does the same for F_ij and F_ji. Half the tolerance, since the error
// is itself only estimated.
double PairExchange::wanted_kernel_error(int i, int j) const {
  const double areas = geometry_.area(i) / geometry_.area(j);
  const double groups = geometry_.group_area(geometry_.group(i)) / geometry_.group_area(geometry_.group(j));
  return 0.5 * tolerance_ * std::sqrt(std::min({areas, 1 / areas, groups, 1 / groups}));
}

void PairExchange::evaluate(int i, const ClusterPair& pair, int first, ExchangeWorkspace& workspace,
                            ClusterExchange& result, const bool* wanted) const {
  const PatchCluster& cluster = *pair.other;
  const int count = cluster.end - cluster.begin;
  result.rays = 0;
  std::fill(result.variance, result.variance + count, 0.0);
  if (pair.nothing || first >= cluster.end) {
    std::fill(result.kernel, result.kernel + count, 0.0);
    return;
  }
  unobstructed_.with_cluster(i, cluster, result.kernel);
  for (int l = 0; l < count; ++l) {
    const int j = cluster.begin + l;
    const bool skipped = j < first || (wanted != nullptr && !wanted[l]);
    result.kernel[l] = skipped ? 0 : result.kernel[l] / std::sqrt(geometry_.area(i) * geometry_.area(j));
  }
  if (!pair.proofs || !pair.candidates.empty()) apply_visibility(i, pair, workspace, result);
}

void PairExchange::apply_visibility(int i, const ClusterPair& pair, ExchangeWorkspace& workspace,
                                    ClusterExchange& result) const {
  const PatchCluster& cluster = *pair.other;
  const int count = cluster.end - cluster.begin;
  std::array<Shaft, PairHeights::capacity> shafts;
  shafts.fill(Shaft::unknown);
  if (pair.proofs) {
    BlockerSet near = between(sides_.patch(i), sides_.cluster(cluster));
    near &= pair.candidates;
    const Shaft all = narrow(geometry_.polygon(i).corners(), cluster.hull, near);
    if (all == Shaft::unknown)
      decide(i, cluster, near, workspace, shafts.data());
    else
      shafts.fill(all);
  }
  for (int l = 0; l < count; ++l) {
    const int j = cluster.begin + l;
    double& kernel = result.kernel[l];
    const Shaft shaft = shafts[static_cast<std::size_t>(l)];
    if (kernel == 0 || shaft == Shaft::clear) continue;
    if (shaft == Shaft::blocked) {
      kernel = 0;
      continue;
    }
    const VisibleFraction fraction = visibility_(i, j, wanted_kernel_error(i, j) / kernel, workspace.record);
    result.rays += fraction.rays;
    result.variance[l] = fraction.variance * kernel * kernel;
    kernel *= fraction.value;
  }
}

}  // namespace radiosity
