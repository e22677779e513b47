#pragma once

#include "foundation/spec.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace radiosity {

struct BuiltInScene {
  std::string name;
  std::string defaults;  ///< keys with their defaults, as a spec: "rooms:n=2,door=0.3,..."
  std::string summary;   ///< one line for --list; with the hard case it serves, where there is one
  Scene (*make)(Spec&);  ///< takes the keys it knows; throws UsageError for values out of range
};

/// The scenes that the project describes itself: cube, cornell-box, rooms, clutter, ...
const std::vector<BuiltInScene>& built_in_scenes();

/// Whether a spec, "name" or "name:key=value,...", names a built-in scene, whatever its keys.
bool names_built_in_scene(const std::string& spec);

/// The scene of a spec; its name is the spec as given. Throws UsageError that lists the known names, or the
/// known keys of that scene.
Scene built_in_scene(const std::string& spec);

/// The room that a group belongs to: the part of its name before the first '/', as in "room2/floor"; the
/// whole name if there is none.
std::string room_of_group(const std::string& group);

}  // namespace radiosity
