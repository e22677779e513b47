#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace radiosity {

struct BuiltInScene {
  std::string name;
  std::string summary;
  Scene (*make)();
};

/// The scenes that the project describes itself: cube, cornell-box, cornell-box-closed, ...
const std::vector<BuiltInScene>& built_in_scenes();

/// Throws UsageError that lists the known names.
Scene built_in_scene(const std::string& name);

}  // namespace radiosity
