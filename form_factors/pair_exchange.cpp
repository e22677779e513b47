#include "form_factors/pair_exchange.hpp"

#include "form_factors/shaft.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

// With more faces that could come between, a proof costs more than the rays that it saves.
constexpr std::size_t kMostBlockers = 512;
constexpr std::size_t kMostCandidates = 24;

// Quadrature is cheap: keep its error two digits below that of the sampling.
double quadrature_tolerance(double tolerance) { return std::clamp(0.01 * tolerance, 1e-14, 1e-6); }

bool all_behind(const std::vector<Eigen::Vector3d>& points, const Plane& plane) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& p) { return plane.height(p) <= PatchGeometry::slack; });
}

ShaftEnd end_of(const PatchCluster& cluster) {
  return {cluster.hull, cluster.coplanar ? &cluster.plane : nullptr};
}

}  // namespace

PairExchange::PairExchange(const PatchMesh& mesh, double tolerance, std::uint64_t seed)
    : geometry_(mesh),
      occluders_(coarse_faces(mesh, geometry_)),
      unobstructed_(geometry_, quadrature_tolerance(tolerance)),
      visibility_(geometry_, occluders_, seed),
      tolerance_(tolerance) {}

bool PairExchange::may_exchange(const PatchCluster& own, const PatchCluster& other) const {
  return !(own.coplanar && all_behind(other.hull, own.plane)) && !(other.coplanar && all_behind(own.hull, other.plane));
}

PairExchange::ClusterPair PairExchange::relate(const PatchCluster& own, const PatchCluster& other) const {
  ClusterPair pair;
  pair.other = &other;
  pair.nothing = !may_exchange(own, other);
  if (pair.nothing) return pair;
  const auto& blockers = occluders_.blockers();
  pair.proofs = blockers.size() <= kMostBlockers;
  if (!pair.proofs) return pair;
  const ShaftEnd first = end_of(own), second = end_of(other);
  for (std::size_t b = 0; b < blockers.size(); ++b) {
    if (misses_shaft(blockers[b], first, second)) continue;
    if (blocks_shaft(blockers[b], first, second)) {
      pair.nothing = true;
      return pair;
    }
    pair.candidates.push_back(static_cast<int>(b));
  }
  pair.proofs = pair.candidates.size() <= kMostCandidates;
  return pair;
}

bool PairExchange::proved_visible(int i, int j, const ClusterPair& pair, bool& blocked) const {
  blocked = false;
  if (!pair.proofs) return false;
  std::array<Eigen::Vector3d, 4> own, other;
  const ConvexPolygon& p = geometry_.polygon(i);
  const ConvexPolygon& q = geometry_.polygon(j);
  for (int k = 0; k < p.corner_count(); ++k) own[static_cast<std::size_t>(k)] = p[k];
  for (int k = 0; k < q.corner_count(); ++k) other[static_cast<std::size_t>(k)] = q[k];
  const ShaftEnd first{{own.data(), static_cast<std::size_t>(p.corner_count())}, &geometry_.plane(i)};
  const ShaftEnd second{{other.data(), static_cast<std::size_t>(q.corner_count())}, &geometry_.plane(j)};
  bool clear = true;
  for (const int b : pair.candidates) {
    const ConvexPolygon& blocker = occluders_.blockers()[static_cast<std::size_t>(b)];
    if (misses_shaft(blocker, first, second)) continue;
    clear = false;
    if (blocks_shaft(blocker, first, second)) {
      blocked = true;
      return false;
    }
  }
  return clear;
}

// With groups g and h of the patches, sum_(i in g, j in h) A_i^2 var F_ij <= tolerance^2 A_g^2 (and the same from h's
// side) holds if var K_ij <= tolerance^2 min(A_g / A_h, A_h / A_g) for every pair: a bound that each pair can check alone.
// The other ratio does the same for F_ij and F_ji. Half the tolerance, since the error is itself only estimated.
double PairExchange::wanted_kernel_error(int i, int j) const {
  const double areas = geometry_.area(i) / geometry_.area(j);
  const double groups = geometry_.group_area(geometry_.group(i)) / geometry_.group_area(geometry_.group(j));
  return 0.5 * tolerance_ * std::sqrt(std::min({areas, 1 / areas, groups, 1 / groups}));
}

void PairExchange::evaluate(int i, const ClusterPair& pair, int first, ClusterExchange& result) const {
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
    double& kernel = result.kernel[l];
    if (j < first) kernel = 0;
    if (kernel == 0) continue;
    kernel /= std::sqrt(geometry_.area(i) * geometry_.area(j));
    if (pair.proofs && pair.candidates.empty()) continue;
    bool blocked = false;
    if (proved_visible(i, j, pair, blocked)) continue;
    if (blocked) {
      kernel = 0;
      continue;
    }
    const VisibleFraction fraction = visibility_(i, j, wanted_kernel_error(i, j) / kernel);
    result.rays += fraction.rays;
    result.variance[l] = fraction.variance * kernel * kernel;
    kernel *= fraction.value;
  }
}

}  // namespace radiosity
