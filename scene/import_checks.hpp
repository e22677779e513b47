#pragma once

#include <string>
#include <string_view>

namespace radiosity {

/// What can be checked of a GLB file before a library reads it: that the lengths it announces fit its size,
/// so that a damaged one does not read beyond the end. Throws Error.
void check_glb(const std::string& file, std::string_view content);

}  // namespace radiosity
