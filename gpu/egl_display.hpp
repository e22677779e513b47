#pragma once

#include <string>
#include <vector>

namespace radiosity {

/// A place without a window where an OpenGL context may be made: an EGLDisplay, not initialized yet.
struct EglDisplay {
  void* handle = nullptr;
  std::string platform;   ///< "EGL device", "surfaceless", "default display"
  bool software = false;  ///< the driver says that it computes on the CPU
};

/// In the order in which they are tried: graphics devices, devices in software, the surfaceless platform, the
/// default display. May be empty. libEGL is there (gpu/gl_library.hpp).
std::vector<EglDisplay> egl_displays();

}  // namespace radiosity
