#pragma once

#include "scene/scene.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace radiosity {

/// What a material library says of one material.
struct MtlEntry {
  std::optional<Color> diffuse;    ///< Kd
  Color emission = Color::Zero();  ///< Ke, radiance
  bool has_texture = false;        ///< map_Kd
};

/// Reads Kd and Ke line by line, correctly rounded. Throws Error "file:line: ..." for numbers that are
/// missing, negative or not finite, for Kd above 1, for spectral curves and for statements before the first
/// newmtl.
std::map<std::string, MtlEntry> scan_mtl(const std::string& file, std::string_view text);

}  // namespace radiosity
