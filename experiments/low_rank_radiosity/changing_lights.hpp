#pragma once

#include "experiments/comparison.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// Document 004, Section 5.4 and Figure 4: a patio whose lamps change from frame to frame.
struct ChangingLightsOptions {
  std::string scene = "patio";
  Index patches = 2412;        ///< n
  Index coarse_patches = 603;  ///< k; the scene's faces are the least
  int frames = 48;             ///< of a turn of the lights
  int pictures = 4;            ///< of them are drawn
  int width = 480;             ///< pixels
  int height = 360;
  double seconds = 1;          ///< of timing
  Index largest_dense = 4000;  ///< n up to which every frame is compared with the dense solution
  double tolerance = 1e-3;     ///< of each F_ep
  std::uint64_t seed = 1;
};

/// How fast a frame comes: E of the lamps, V'E and B in all channels.
struct LightFrameTimes {
  int threads = 0;
  Timing one_channel;    ///< B = E - Y (V'E) with the Y of the first channel, as the document does
  Timing three_factors;  ///< the same for each channel with a Y of its own
  Timing shared_factor;  ///< all channels from one U (shared_factor_frame.hpp)
};

struct ChangingLights {
  std::shared_ptr<const PatchMesh> mesh;
  Index coarse_patches = 0;  ///< as many as there were in the end
  Eigen::MatrixXd powers;    ///< of each lamp in each frame, 0 to 1: frames x lamps
  std::uint64_t rays = 0;
  double factor_seconds = 0;           ///< to compute U
  double fold_seconds = 0;             ///< to make the Y of all channels
  double shared_seconds = 0;           ///< to make the k x k matrices of all channels
  std::size_t three_factor_bytes = 0;  ///< Y of all channels and V
  std::size_t shared_factor_bytes = 0;
  double load_before = 0;
  double load_after = 0;
  std::vector<LightFrameTimes> times;  ///< one thread, all threads
  double largest_disagreement = 0;     ///< of both ways in any frame, relative in the area norm
  std::vector<double> errors;    ///< of each frame against the dense solution, empty where n is too large
  std::vector<int> drawn;        ///< frames of which there are pictures
  std::vector<Field> radiosity;  ///< of these: n x channels, in the order of the mesh
};

/// Throws UsageError where the scene has no light or more faces than coarse_patches.
ChangingLights measure_changing_lights(const ChangingLightsOptions& options, Monitor& monitor);

/// The table, the picture strip and the curves.
ReportSection changing_lights_section(const ChangingLights& lights, const std::filesystem::path& strip,
                                      const std::string& command);

/// Measures, writes low_rank_patio.json, low_rank_patio/0000.png ... and low_rank_patio.png (some of them
/// side by side) into `folder`, returns the section.
ReportSection changing_lights(const std::filesystem::path& folder, const std::string& command,
                              const ChangingLightsOptions& options, Monitor& monitor);

}  // namespace radiosity
