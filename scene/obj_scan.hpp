#pragma once

#include "scene/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace radiosity {

/// What the lines of an OBJ file say, checked line by line before the file is parsed.
struct ObjScan {
  /// One face line.
  struct FaceLine {
    int group = 0;     ///< index into group_names
    int material = 0;  ///< index into material_names
  };

  std::vector<Vector3> vertices;            ///< correctly rounded
  std::vector<FaceLine> faces;              ///< in the order of the file
  std::vector<std::string> group_names;     ///< `g`, else `o`, else the material; "default" without any
  std::vector<std::string> material_names;  ///< as in `usemtl`; "" for faces before the first
  std::size_t unknown_lines = 0;            ///< statements that OBJ does not have
  std::size_t first_unknown_line = 0;
};

/// Throws Error "file:line: ..." for numbers that are not finite or no numbers, vertices with fewer than
/// three, faces with fewer than three corners and indices that refer to no vertex.
ObjScan scan_obj(const std::string& file, std::string_view text);

}  // namespace radiosity
