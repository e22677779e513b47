#pragma once

#include "scene/scene.hpp"

#include <filesystem>
#include <string>

namespace radiosity {

/// Reads OBJ+MTL, PLY and STL text in double precision, glTF and GLB in single. Planar convex quads stay
/// quads, other polygons become triangles. MTL Ke and glTF emissive are radiance: emission = pi Ke. No
/// material: reflectance 0.5. Throws Error with file (and line, where the format has lines) for anything
/// unreadable: NaN, infinity, bad indices, empty and truncated files.
Scene import_scene(const std::filesystem::path& file);

/// A file if `name_or_file` names one or has a known extension, else the built-in scene of that spec.
/// Throws Error that lists the built-in names, or the keys of the scene, for anything else.
Scene open_scene(const std::string& name_or_file);

}  // namespace radiosity
