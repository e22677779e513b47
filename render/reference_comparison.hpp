#pragma once

#include "render/path_tracer.hpp"

#include <string>
#include <vector>

namespace radiosity {

/// A solution beside the referee's, in one group of the scene.
struct GroupDifference {
  std::string group;
  double area = 0;            ///< m^2
  double reference = 0;       ///< mean reflected light of the path tracer, W/m^2, over area and channels
  double difference = 0;      ///< mean of solution - reference, W/m^2
  double standard_error = 0;  ///< of `difference`, W/m^2
};

/// How a radiosity solution differs from path tracing. All of it is about reflected light B - E = rho H:
/// emission is the same in both, and would only make the differences look smaller. Means are over area and
/// channels. "Relative" is to the referee's mean reflected light.
struct ReferenceComparison {
  /// Relative difference of the means, signed: does the solution hold the right amount of light?
  double mean_difference = 0;
  double mean_difference_standard_error = 0;
  /// Relative root mean square of the difference of single patches with the referee's own noise taken out
  /// (its mean square is subtracted; 0 where nothing is left): is the light in the right places?
  double rms_difference = 0;
  /// Of rms_difference, if all channels had the same noise (they follow the same paths).
  double rms_difference_standard_error = 0;
  /// Relative root mean square noise of the referee on single patches.
  double rms_standard_error = 0;
  /// Fraction of patches and channels that differ by more than 4 standard errors.
  double beyond_four_standard_errors = 0;
  std::vector<GroupDifference> groups;  ///< those with area, in the scene's order
};

/// Compares B (n x channels, W/m^2) with path tracing of the same mesh. Patches are independent; channels
/// follow the same paths, so that their standard errors are added up as if they always went the same way
/// (never too small). Throws UsageError for wrong shapes, and Error if the referee found no reflected light
/// to compare with.
ReferenceComparison compare_with_reference(const PatchMesh& mesh, const Eigen::MatrixXd& B,
                                           const PathTracedIrradiance& reference);

}  // namespace radiosity
