#pragma once

#include "foundation/error.hpp"
#include "frame/frame_light.hpp"
#include "scene/patch_mesh.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace radiosity {

/// Where the light of a frame is, and from where it is seen if not from the scene's camera.
struct FrameView {
  Vector3 light = Vector3::Zero();
  std::optional<Vector3> camera;
  std::optional<Vector3> target;  ///< there if the camera is
};

/// One turn about the vertical axis (y) through the middle of the scene's bounding box: half as wide and deep
/// as the box, at four fifths of its height. Throws UsageError for less than one frame.
std::vector<FrameView> orbit_path(const PatchMesh& mesh, int frames);

/// A text with one line a frame: the light's position x y z, or nine numbers, light, camera and its target;
/// separated by spaces. Empty lines and what follows a '#' do not count. Throws UsageError naming file and
/// line where it is not one.
std::vector<FrameView> read_frame_path(const std::filesystem::path& file);

/// A camera at the place of a view; else the scene's own, or default_camera().
Camera camera_of(const FrameView& view, const PatchMesh& mesh);

}  // namespace radiosity
