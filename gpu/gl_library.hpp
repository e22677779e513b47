#pragma once

#include <string>
#include <vector>

namespace radiosity {

/// A shared library that OpenGL without a window needs, under any of some names, and the Debian package that
/// has it.
struct GlLibrary {
  std::vector<std::string> names;
  std::string package;
};

/// libEGL and libOpenGL (or libGL).
const std::vector<GlLibrary>& required_gl_libraries();

/// One sentence that names the first of `libraries` that cannot be loaded and its package; empty if all can.
/// To be asked before the first call of OpenGL or EGL: libepoxy ends the process where they are missing.
std::string missing_gl_library(const std::vector<GlLibrary>& libraries = required_gl_libraries());

}  // namespace radiosity
