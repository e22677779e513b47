#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace radiosity {

/// A file of gpu/shaders with the constants that it is compiled with.
struct ShaderVariant {
  std::string file;                                  ///< "dense_group.comp"
  std::vector<std::pair<std::string, int>> defines;  ///< {{"COLUMNS", 3}}

  bool operator==(const ShaderVariant&) const = default;
};

/// The whole text that OpenGL compiles: version, constants, the file with each #include "..." replaced by
/// that file. Throws UsageError for files that do not exist.
std::string shader_text(const ShaderVariant& variant);

/// A file of gpu/shaders, as it was when the library was built.
struct ShaderFile {
  std::string_view name;
  std::string_view text;
};
const std::vector<ShaderFile>& shader_files();

}  // namespace radiosity
