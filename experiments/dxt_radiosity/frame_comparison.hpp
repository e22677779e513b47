#pragma once

#include "experiments/dxt_radiosity/column_profile.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "frame/picture_difference.hpp"
#include "gpu/gl_device.hpp"
#include "operators/operator_registry.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// Document 000, sections 4.2 and 4.3, Figures 13 and 14: one frame by several methods.
struct FrameComparisonOptions {
  std::string scene = "colonnade";
  std::string column = "column6";  ///< whose side towards the nave the profile is of
  Index patches = 800;
  double tolerance = 3e-3;  ///< of form factors
  int width = 256;          ///< pixels
  int height = 144;
  int shadow_size = 1024;
  int points = 6;            ///< strata x strata on each patch
  int bands = 16;            ///< of the profile
  int reference_paths = 96;  ///< from each pixel
  double closest = 0.5;      ///< of instant radiosity, m
  int times_more = 64;       ///< paths of its second frame for one of the first
  int cells = 32;            ///< of light propagation volumes, along the longest edge of the scene
  int steps = 64;            ///< of theirs, from cell to cell
  double seconds = 0.5;      ///< for timing each method's frames
  std::uint64_t seed = 1;
};

/// The name of the frame by the reference's own method.
inline constexpr const char* path_tracing_name = "path tracing";

/// A frame of one method beside the reference.
struct ComparedFrame {
  std::string name;
  std::string settings;        ///< the operator, or how many paths
  std::string computed_on;     ///< "device" or "cpu"
  double seconds = 0;          ///< of a frame, from light and camera to the picture: median
  PictureDifference whole;     ///< over all pixels
  PictureDifference shadowed;  ///< over those that no light reaches straight: indirect light alone
  Eigen::MatrixX3d profile;    ///< along the column, bands x 3, W/(m^2 sr)
};

struct FrameComparison {
  std::shared_ptr<const PatchMesh> mesh;
  std::string renderer;
  bool software = false;  ///< the renderer computes on the CPU
  TracedFrame reference;
  double reference_seconds = 0;
  ColumnBands bands;
  Eigen::MatrixX3d reference_profile;
  double shadowed_part = 0;  ///< of the pixels
  std::vector<ComparedFrame> frames;
  std::vector<Picture> pictures;  ///< of the frames, in their order
  double equal_error_paths = 0;   ///< a pixel, with which path tracing is as far off as the first frame
  double equal_error_seconds = 0;
};

/// The first frame is that of the document's method; after those of radiosity come light propagation volumes,
/// path tracing to the first one's error, and instant radiosity in its time and with many more virtual
/// lights. Throws UsageError for a column that is not seen.
FrameComparison measure_frame_comparison(const std::shared_ptr<GlDevice>& device,
                                         const FrameComparisonOptions& options,
                                         const OperatorRegistry& operators, Monitor& monitor);

/// How the colour gradient of a frame's column compares with the reference's, 1/m.
double gradient_of(const FrameComparison& comparison, const ComparedFrame& frame);

/// The texts, tables and profiles; the figures of pictures are added by frame_comparison().
ReportSection frame_comparison_section(const FrameComparison& comparison,
                                       const FrameComparisonOptions& options, const std::string& command);

/// Measures, writes frame_comparison.json, .png, _reference.png and _difference.png into `folder` (made if it
/// is missing), returns the section.
ReportSection frame_comparison(const std::filesystem::path& folder, const std::string& command,
                               const std::shared_ptr<GlDevice>& device, const FrameComparisonOptions& options,
                               const OperatorRegistry& operators, Monitor& monitor);

/// What the report has in its place where there is no OpenGL: `reason`, which names the package.
ReportSection skipped_frame_comparison(const std::string& reason);

}  // namespace radiosity
