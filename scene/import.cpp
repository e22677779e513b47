#include "scene/import.hpp"

#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "scene/import_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace radiosity {
namespace {

constexpr std::array<std::string_view, 5> kExtensions = {".obj", ".ply", ".stl", ".gltf", ".glb"};

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_known(const std::string& extension) {
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace

Scene import_scene(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  if (!is_known(extension))
    fail("'{}' is of no known format; OBJ, PLY, STL, glTF and GLB can be read, told by the extension",
         file.string());
  if (!std::filesystem::exists(file)) fail("there is no file '{}'", file.string());
  if (extension == ".obj") return import_obj(file);
  if (extension == ".ply") return import_ply(file);
  return extension == ".stl" ? import_stl(file) : import_with_assimp(file);
}

Scene open_scene(const std::string& name_or_file) {
  const std::filesystem::path path(name_or_file);
  if (std::filesystem::is_regular_file(path) || is_known(lower_extension(path))) return import_scene(path);
  if (name_or_file.find('/') != std::string::npos) fail("there is no file '{}'", name_or_file);
  return built_in_scene(name_or_file);
}

}  // namespace radiosity
