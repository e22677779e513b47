#pragma once

#include "form_factors/blocker_sides.hpp"
#include "form_factors/form_factors.hpp"
#include "form_factors/occluders.hpp"
#include "form_factors/patch_geometry.hpp"
#include "form_factors/unobstructed_exchange.hpp"
#include "form_factors/visible_fraction.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace radiosity {

/// Room for the work of one thread; carries separating planes from one pair to the next.
struct ExchangeWorkspace {
  std::vector<Eigen::Vector3d> separating;   ///< per blocker
  std::vector<RayPacket>* record = nullptr;  ///< receives every packet, if not null
};

/// Exchanges of one patch with a cluster: A_i F_ij / sqrt(A_i A_j), that is K_ij, and what their sampling
/// left open.
struct ClusterExchange {
  double kernel[PairHeights::capacity];
  double variance[PairHeights::capacity];  ///< of kernel; 0 where nothing was sampled
  std::uint64_t rays = 0;
};

/// The accurate method for any pair of patches: the unobstructed exchange, times the visible fraction where
/// neither visibility nor blockage can be proved. Each K_ij depends on the pair, the seed and the tolerance
/// alone, so that rows on demand and the assembled kernel agree.
class PairExchange {
 public:
  /// tolerance: estimated standard error of each F_ij and of each F between groups. least_rays: of a pair
  /// whose visibility cannot be proved, a multiple of 64.
  PairExchange(const PatchMesh& mesh, double tolerance, std::uint64_t seed,
               std::uint64_t least_rays = VisibilitySampling::usual_least_rays);

  const PatchGeometry& geometry() const { return geometry_; }
  const Occluders& occluders() const { return occluders_; }

  ExchangeWorkspace make_workspace() const;

  /// What is known of two clusters before any pair of theirs is looked at.
  struct ClusterPair {
    const PatchCluster* other = nullptr;
    bool nothing =
        false;  ///< they face away from each other, or one face hides all of one from all of the other
    bool proofs = true;  ///< candidates holds every face that may come between; false: too many, rays decide
    BlockerSet candidates;
  };
  ClusterPair relate(const PatchCluster& own, const PatchCluster& other) const;

  /// The cheap part of relate: false only if the clusters face away from each other.
  bool may_exchange(const PatchCluster& own, const PatchCluster& other) const;

  /// K_ij of patch i (of the pair's own cluster) with the other cluster's patches j >= first; 0 for j <
  /// first and, unless `wanted` is null, for those that it has false for.
  void evaluate(int i, const ClusterPair& pair, int first, ExchangeWorkspace& workspace,
                ClusterExchange& result, const bool* wanted = nullptr) const;

 private:
  enum class Shaft : unsigned char { clear, blocked, unknown };
  // Keeps the candidates that may come between two ends.
  Shaft narrow(const ShaftEnd& first, const ShaftEnd& second, BlockerSet& candidates) const;
  // What the candidates prove about patch i and each patch of a cluster.
  void decide(int i, const PatchCluster& cluster, const BlockerSet& candidates, ExchangeWorkspace& workspace,
              Shaft* shafts) const;
  // Sorts out what one blocker does to the still open pairs of patch i.
  void decide(int i, const PatchCluster& cluster, std::size_t blocker, Eigen::Vector3d& direction,
              unsigned char* open, Shaft* shafts) const;
  void apply_visibility(int i, const ClusterPair& pair, ExchangeWorkspace& workspace,
                        ClusterExchange& result) const;
  double wanted_kernel_error(int i, int j) const;

  PatchGeometry geometry_;
  Occluders occluders_;
  BlockerSideTable sides_;
  UnobstructedExchange unobstructed_;
  VisibilitySampling visibility_;
  double tolerance_;
};

}  // namespace radiosity
