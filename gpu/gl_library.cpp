#include "gpu/gl_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dlfcn.h>

namespace radiosity {
namespace {

/// What was loaded stays loaded: the driver behind it starts threads that outlive a dlclose.
bool loads(const std::string& name) {
  return dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL) != nullptr;
}

}  // namespace

const std::vector<GlLibrary>& required_gl_libraries() {
  static const std::vector<GlLibrary> libraries = {{{"libEGL.so.1"}, "libegl1"},
                                                   {{"libOpenGL.so.0", "libGL.so.1"}, "libopengl0"}};
  return libraries;
}

std::string missing_gl_library(const std::vector<GlLibrary>& libraries) {
  for (const GlLibrary& library : libraries)
    if (std::none_of(library.names.begin(), library.names.end(), loads))
      return fmt::format(
          "there is no OpenGL here: {} cannot be loaded; install the Debian packages {} and libgl1-mesa-dri",
          library.names.front(), library.package);
  return {};
}

}  // namespace radiosity
