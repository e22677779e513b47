#pragma once

#include "scene/patch_mesh.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace radiosity {

/// Which scene, how finely cut, and what replaces its materials.
struct SceneOptions {
  std::string scene;  ///< a file or a built-in name; empty: not given
  std::optional<Index> patches;
  std::optional<double> edge;
  bool two_sided = false;
  std::optional<double> reflectance;
  std::optional<double> max_reflectance;
  std::string emission_file;
  std::vector<std::string> group_settings;  ///< GROUP:reflectance=...,emission=...
};

/// Registers SCENE and the options above.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// Opens, cuts and paints the scene. Throws UsageError where SCENE was not given, and what the importer, the
/// subdivision and apply_materials throw.
std::shared_ptr<const PatchMesh> open_mesh(const SceneOptions& options);

}  // namespace radiosity
