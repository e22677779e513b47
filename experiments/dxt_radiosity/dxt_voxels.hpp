#pragma once

#include "experiments/lights.hpp"
#include "experiments/report.hpp"
#include "experiments/simplification_error.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace radiosity {

/// A built-in scene and into how many patches it is cut: those are the reference.
struct VoxelStudyScene {
  std::string spec;
  Index patches = 0;
};

/// What document 000's simplification (section 3.2) does to indirect light, over the number of voxels.
struct DxtVoxelsOptions {
  std::vector<VoxelStudyScene> scenes = {
      {"cornell-box-closed", 700}, {"clutter", 700}, {"patio", 800}, {"sphere-cavity:rings=16", 700}};
  std::vector<Index> wanted = {50, 100, 200, 400, 600};  ///< N of `solve --simplify voxels:N`, rising
  LightCounts lights = {.area = 2, .point = 2};          ///< beside the scene's own
  double tolerance = 3e-3;                               ///< of form factors
  std::uint64_t seed = 1;
};

/// A scene over N.
struct VoxelErrors {
  std::string scene;
  Index patches = 0;  ///< of the original
  Index lights = 0;
  bool enclosure = false;
  double form_factor_seconds = 0;                ///< of the original
  std::vector<SimplificationError> over_voxels;  ///< N rises
};

struct DxtVoxels {
  std::vector<VoxelErrors> scenes;

  /// Throws Error where the scene was not measured.
  const VoxelErrors& scene(const std::string& spec) const;
};

/// Throws UsageError where there is no scene, or no N.
DxtVoxels measure_dxt_voxels(const DxtVoxelsOptions& options, Monitor& monitor);

/// How the error of a scene falls from the fewest to the most voxels, and what averaging alone costs there.
std::string voxel_finding(const VoxelErrors& errors);
/// Which scenes the simplification itself fails: where the error ends far above that of averaging.
std::string voxel_fault_finding(const DxtVoxels& voxels);

ReportSection dxt_voxels_section(const DxtVoxels& voxels, const DxtVoxelsOptions& options,
                                 const std::string& command);

/// Measures, writes dxt_voxels.json into `folder` (made if it is missing), returns the section.
ReportSection dxt_voxels(const std::filesystem::path& folder, const std::string& command,
                         const DxtVoxelsOptions& options, Monitor& monitor);

}  // namespace radiosity
