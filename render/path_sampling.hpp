#pragma once

#include "foundation/random.hpp"
#include "scene/patch_mesh.hpp"

#include <vector>

namespace radiosity {

/// Maps (u, v) in [0, 1)^2 to a point of a patch, uniformly by area; connected where the patch is.
Vector3 point_on_patch(const PatchMesh& mesh, Index patch, double u, double v);

/// Maps (u, v) in [0, 1)^2 to a direction about `normal` with density cos / pi.
Vector3 cosine_direction(const Vector3& normal, double u, double v);

/// Picks emitting patches with probability proportional to area times emission (largest channel).
class EmitterTable {
 public:
  explicit EmitterTable(const PatchMesh& mesh);

  bool empty() const { return emitters_.empty(); }

  /// The emitter at u in [0, 1).
  Index pick(double u) const;

  /// Density, per unit of area, with which pick() followed by a uniform point yields a point of `patch`; 0
  /// where it is dark.
  double density(Index patch) const { return density_[patch]; }

 private:
  std::vector<Index> emitters_;
  std::vector<double> cumulative_;  // power up to and including each emitter
  Eigen::VectorXd density_;
};

}  // namespace radiosity
