#pragma once

#include "foundation/monitor.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace radiosity {

/// How the light at the ends of a path is found. Both have the same mean; they differ in variance.
enum class LightSampling {
  on_hit,   ///< a path collects the emission of the fronts that it happens to hit
  combined  ///< also one point on an emitter per bounce; both weighted by the balance heuristic (Veach
            ///< 1997, 9.2.2)
};

struct PathTracingOptions {
  int paths = 1024;  ///< paths from each patch and round; rounded up to whole batches of 16, at least 64
  double standard_error = 0;  ///< > 0: more rounds until the mean relative standard error is at most this
  double seconds = 0;         ///< > 0: no new round after this much wall time; alone: rounds until then
  LightSampling lights = LightSampling::combined;
  std::uint64_t seed = 1;
};

/// Irradiance as the path tracer estimates it.
struct PathTracedIrradiance {
  Eigen::MatrixXd irradiance;      ///< H, n x channels, W/m^2, average over each patch
  Eigen::MatrixXd standard_error;  ///< of H, n x channels, W/m^2, from independent batches of paths
  std::uint64_t paths = 0;         ///< from each patch
  std::uint64_t rays = 0;          ///< of all patches; shadow rays included
  std::uint64_t misses = 0;        ///< paths that left the scene
  std::uint64_t back_hits = 0;     ///< paths absorbed by the back of a patch
  std::uint64_t leaks = 0;         ///< misses in an enclosure, which has no way out
  double seconds = 0;

  /// Root mean square of the standard error over the area and channels, relative to the mean irradiance.
  double relative_standard_error(const Eigen::VectorXd& area) const;
};

/// The referee of the other solvers: follows light paths backwards from random points of every patch through
/// diffuse reflections, and shares no transport code with them (no form factors, kernels or solvers). B = E +
/// rho H. Its light is constant on no patch but what they emit, so radiosity's B differs from it by the
/// discretization, less and less the more patches there are. Backs absorb; what leaves the scene is lost.
/// Paths end by Russian roulette, without bias. The result depends on the seed but not on the number of
/// threads (with `seconds`, the number of rounds does). Throws UsageError for options out of range and for
/// rho >= 1, where paths need not end (naming the patch).
PathTracedIrradiance trace_paths(const PatchMesh& mesh, const PathTracingOptions& options, Monitor& monitor);

}  // namespace radiosity
