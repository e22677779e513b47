#include "gpu/egl_display.hpp"

#define EGL_NO_X11
#include <algorithm>
#include <array>
#include <epoxy/egl.h>
#include <string_view>

namespace radiosity {
namespace {

/// Whether a list of words that are separated by spaces has the word.
bool has_word(const char* list, std::string_view word) {
  if (list == nullptr) return false;
  std::string_view rest(list);
  while (!rest.empty()) {
    const std::size_t end = rest.find(' ');
    if (rest.substr(0, end) == word) return true;
    if (end == std::string_view::npos) return false;
    rest.remove_prefix(end + 1);
  }
  return false;
}

std::vector<EglDisplay> device_displays(const char* extensions) {
  if (!has_word(extensions, "EGL_EXT_platform_device") || !has_word(extensions, "EGL_EXT_device_enumeration"))
    return {};
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return {};
  std::vector<EglDisplay> displays;
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (display == EGL_NO_DISPLAY) continue;
    const bool software =
        has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    displays.push_back({display, "EGL device", software});
  }
  std::stable_partition(displays.begin(), displays.end(),
                        [](const EglDisplay& display) { return !display.software; });
  return displays;
}

}  // namespace

std::vector<EglDisplay> egl_displays() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EglDisplay> displays = device_displays(extensions);
  if (has_word(extensions, "EGL_MESA_platform_surfaceless") && has_word(extensions, "EGL_EXT_platform_base"))
    displays.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                        "surfaceless"});
  displays.push_back({eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display"});
  std::erase_if(displays, [](const EglDisplay& display) { return display.handle == EGL_NO_DISPLAY; });
  return displays;
}

}  // namespace radiosity
