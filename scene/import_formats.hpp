#pragma once

#include "scene/scene.hpp"

#include <filesystem>

namespace radiosity {

/// The importers behind import_scene(), chosen by the extension.
Scene import_obj(const std::filesystem::path& file);
Scene import_ply(const std::filesystem::path& file);
Scene import_stl(const std::filesystem::path& file);
Scene import_with_assimp(const std::filesystem::path& file);

}  // namespace radiosity
