#pragma once

#include "experiments/comparison.hpp"
#include "frame/frame_renderer.hpp"
#include "frame/picture_difference.hpp"
#include "operators/linear_operator.hpp"
#include "scene/patch_mesh.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The last frame beside the path-traced one.
struct FrameReference {
  int samples = 0;
  double seconds = 0;
  PictureDifference difference;
};

/// What `render` tells.
struct FrameReport {
  std::string operator_name;
  DeviceUse device;
  std::string version;  ///< of OpenGL
  FrameOptions options;
  bool spot = false;
  int products = 1;   ///< a frame
  Index points = 0;   ///< on a patch
  Index patches = 0;  ///< that were solved on
  double exposure = 1;
  std::vector<std::vector<double>> stage_seconds;  ///< of frame_stages, one list a stage
  std::vector<double> frame_seconds;               ///< wall time to draw a frame and collect the one before
  std::optional<FrameReference> reference;
};

void print_frames(const PatchMesh& shown, const FrameReport& report);
void write_frames_json(const std::filesystem::path& file, const PatchMesh& shown, const FrameReport& report);

}  // namespace radiosity
