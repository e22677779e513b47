#pragma once

#include "operators/linear_operator.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// Lights and the radiosity that they make: n x (lights * channels), the channels of a light side by side.
struct SolvedLights {
  Field emission;
  Field radiosity;

  Index count(const PatchMesh& mesh) const { return emission.cols() / mesh.channels(); }
  /// Lights first ... first + count - 1.
  SolvedLights part(const PatchMesh& mesh, Index first, Index count) const;
};

/// The least error that B = E + X Y' E can have with X and Y of n x k, one pair a channel, over a
/// distribution of lights: that of the SVD of (G - I) C^{1/2} in the area norm, G = (I - T)^{-1} and C the
/// covariance of E (Eckart and Young; methods.md, "Best rank k"). Every operator of rank k gives such an X
/// and Y by Woodbury's formula (document 004, Equation 4). Lights count by their relative error, as
/// relative_errors has it: the covariance is that of E / ||B||_A, so that the root mean square of relative
/// errors is what is least.
class BestRank {
 public:
  /// The distribution: `probability` of each light of `lights`, at least 0, one a light. C has no part but
  /// theirs: with fewer lights than k the best of rank k is that of their number. Throws UsageError where
  /// sizes differ.
  BestRank(const PatchMesh& mesh, const SolvedLights& lights, const Eigen::VectorXd& probability);

  /// The B of rank k <= n nearest to the true one for these lights: E plus the projection of B - E on the
  /// first k singular vectors of each channel (all there are, if fewer), n x (lights * channels).
  Field radiosity(Index k, const SolvedLights& lights) const;

 private:
  Eigen::VectorXd root_area_;
  std::vector<Eigen::MatrixXd>
      directions_;  ///< one a channel, n x min(n, lights), orthonormal, the leading ones first
};

}  // namespace radiosity
