#pragma once

#include <map>
#include <string>
#include <string_view>

namespace radiosity {

/// What a material library says of one material beyond the numbers: which of them are there at all.
struct MtlEntry {
  bool has_diffuse = false;
  bool has_texture = false;
};

/// Checks Kd and Ke line by line. Throws Error "file:line: ..." for numbers that are missing, negative or not
/// finite, for Kd above 1, for spectral curves and for statements before the first newmtl.
std::map<std::string, MtlEntry> scan_mtl(const std::string& file, std::string_view text);

}  // namespace radiosity
